"""Write a module of the engine for another kind of processor: the same text with other module names.

Arguments: source, target, the suffix, and the names of all modules that get it.
"""

import re
import sys
from pathlib import Path

source, target, suffix, *modules = sys.argv[1:]
text = Path(source).read_text(encoding="utf-8")
text = re.sub(rf"\b({'|'.join(modules)})\b", rf"\1_{suffix}", text)
Path(target).write_text(text, encoding="utf-8")
