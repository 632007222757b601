"""Write a module of the engine for another kind of processor, or for numbers of every lane: the same text with other module names.

Arguments: source, target, "_own" for numbers of every lane (cases/lane_stiffness.f90) or "", the suffix of the processor or "",
and the names of the modules that are there for both, "--", and of those that are there once for each processor.
"""

import re
import sys
from pathlib import Path

source, target, own, level, *names = sys.argv[1:]
both, once = names[: names.index("--")], names[names.index("--") + 1 :]
text = Path(source).read_text(encoding="utf-8")
text = re.sub(rf"\bgapbeam_({'|'.join(both)})\b", rf"gapbeam_\1{own}{level}", text)
text = re.sub(rf"\bgapbeam_({'|'.join(once)})\b", rf"gapbeam_\1{level}", text)
if own:
    text = text.replace("stiffness_lanes = 1", "stiffness_lanes = lanes")
Path(target).write_text(text, encoding="utf-8")
