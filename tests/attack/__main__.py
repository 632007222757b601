"""The attack: scenes drawn at random in families, solved by gapbeam and judged by other means.

    python tests/attack --count 20000 --jobs 2                  # every family
    python tests/attack --family signs --seconds 60 --jobs 2
    python tests/attack --scene FAILURE.json                    # judge one scene again

It attacks whatever gapbeam Python imports. Every failure is written as a scene that reproduces it; its title says what is wrong.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(1, os.path.join(sys.path[0], "oracle", "checkers"))

from attack.command import main

if __name__ == "__main__":
    sys.exit(main())
