"""Copy compiled Fortran modules from where the compiler leaves them, so that meson knows them by name and installs them.

Usage: copy_modules.py DESTINATION FOLDER OTHER-FOLDER MODULE...
"""

import shutil
import sys
from pathlib import Path

destination, *folders = map(Path, sys.argv[1:4])
for name in sys.argv[4:]:
    (found,) = (folder / name for folder in folders if (folder / name).exists())
    shutil.copyfile(found, destination / name)
