"""``python -m gapbeam`` is the command ``gapbeam``."""

from .cli import main

if __name__ == "__main__":
    raise SystemExit(main())
