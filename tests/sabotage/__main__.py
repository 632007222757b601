"""The sabotage: lines of gapbeam changed for the worse, one at a time in a copy, and the tests of that room run against each.

    python tests/sabotage                       # all of tests/sabotage/changes.toml
    python tests/sabotage --only cases --list   # those of rooms or files that have this in their name
    python tests/sabotage --jobs 2

A change is killed if a test fails, and survives if none does. The exit status is 1 if one survives that is not said to survive, or
cannot be tried.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from sabotage.command import main

if __name__ == "__main__":
    sys.exit(main())
