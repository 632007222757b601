"""Write a module of the engine in quadruple precision: the same text with another kind and other module names.

Arguments: source, target, and the names of all modules that there are in both precisions; each gets the suffix _quad.
"""

import re
import sys
from pathlib import Path

source, target, *modules = sys.argv[1:]
text = Path(source).read_text(encoding="utf-8")
text = re.sub(rf"\b({'|'.join(modules)})\b", r"\1_quad", text)
text = re.sub(r"(use gapbeam_kinds, only:.*)\bwp\b", r"\1wp => qp", text)
text = text.replace(", bind(c) ::", " ::")  # C has no such numbers
Path(target).write_text(text, encoding="utf-8")
