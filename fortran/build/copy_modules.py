"""Copy compiled Fortran modules from where the compiler leaves them, so that meson knows them by name and installs them.

Usage: copy_modules.py FOLDER DESTINATION MODULE...
"""

import shutil
import sys
from pathlib import Path

folder, destination, *names = sys.argv[1:]
for name in names:
    shutil.copyfile(Path(folder, name), Path(destination, name))
