"""Copy the compiled Fortran modules to the place where they are installed.

Usage: install_modules.py FOLDER DESTINATION      (meson sets MESON_INSTALL_DESTDIR_PREFIX)
"""

import os
import shutil
import sys
from pathlib import Path

source, destination = Path(sys.argv[1]), Path(os.environ["MESON_INSTALL_DESTDIR_PREFIX"]) / sys.argv[2]
destination.mkdir(parents=True, exist_ok=True)
for module in sorted(source.glob("*.mod")):
    shutil.copy2(module, destination)
