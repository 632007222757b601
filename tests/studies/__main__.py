"""The studies that measure the program itself: each prints a table, and writes its page of the documentation.

    python tests/studies extremes
    python tests/studies contact --largest 1000 --csv contact.csv
    python tests/studies foundation --markdown docs/foundation-study.md --plot docs/foundation-study.svg

They measure whatever gapbeam Python imports. `gapbeam study accuracy` is for beams of users, and installed.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from gapbeam.cli import prepare_libraries, see_to_signals

if __name__ == "__main__":
    see_to_signals()
    prepare_libraries()
    from studies.command import main

    sys.exit(main())
