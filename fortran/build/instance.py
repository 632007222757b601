"""Write an instance of a module: the same text in which other names stand for some modules.

Usage: instance.py SOURCE TARGET [MODULE=OTHER...]. So a source is compiled in quadruple precision, for another kind of processor,
or for stiffnesses that differ from case to case; without other names it is a copy that is made anew when what it includes changes.
"""

import re
import sys
from pathlib import Path

source, target, *pairs = sys.argv[1:]
other = dict(pair.split("=") for pair in pairs)
text = Path(source).read_text(encoding="utf-8")
Path(target).write_text(re.sub(r"\bgapbeam_\w+", lambda name: other.get(name[0], name[0]), text), encoding="utf-8")
