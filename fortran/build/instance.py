"""Write an instance of a module: the same text in which other names stand for some modules.

Usage: instance.py SOURCE TARGET [MODULE=OTHER...]. So a source is compiled in quadruple precision, for another kind of processor,
or for stiffnesses that differ from case to case; without other names it is a copy that is made anew when what it includes changes.
Where only the Python that runs this has changed nothing is written, and nothing compiled anew (ninja's restat).
"""

import re
import sys
from pathlib import Path

source, target, *pairs = sys.argv[1:]
other = dict(pair.split("=") for pair in pairs)
text = re.sub(r"\bgapbeam_\w+", lambda name: other.get(name[0], name[0]), Path(source).read_text(encoding="utf-8"))
written = Path(target)
changed = max(path.stat().st_mtime for path in (Path(source), *Path(__file__).parents[1].rglob("*.inc")))
if not written.exists() or written.stat().st_mtime <= changed or written.read_text(encoding="utf-8") != text:
    written.write_text(text, encoding="utf-8")
