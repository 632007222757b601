"""The digests: is every number of this tree that of another commit, to the last bit?

    python tests/digests                        # this tree beside the commit before
    python tests/digests --beside main --count 20000
    python tests/digests --within 1e-12        # the numbers themselves, to a share of the largest of their kind in a scene

Both are built on this machine, and solve the same scenes through Python, C and Fortran 77; sha256 of what comes out is
compared, one for every kind of number. Builds stay in `.venv/digests`, a commit's digests too: they depend on processor, compiler
and mathematical library, so none is in the repository. The exit status is 1 if a number has changed, or a kind of number is gone.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from digests.command import main

if __name__ == "__main__":
    sys.exit(main())
