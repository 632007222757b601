"""Write the lists of files in docs/house.md, or print what the files of a room do, from the heads of modules.

``python docs/house.py`` rewrites the lists; ``python docs/house.py fortran/contact`` prints what every file of a room does.
"""

import ast
import re
import sys
import textwrap
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
HOUSE = TOP / "docs" / "house.md"
BEGIN, END = "<!-- lists of files: python docs/house.py -->\n", "<!-- end of the lists -->\n"
WIDTH = 120
FORTRAN = {
    "base": "precisions, errors and status codes, memory, whether a call may go on",
    "beam": "a stretch of beam: stiffness, loads, fields, on elastic ground too",
    "elimination": "one linear system: elimination, three-moment equations, residuals",
    "contact": "which supports act: laws, signs, search for the contact state, zones on the ground",
    "precision": "extended precision, audit of every answer, certificates and error bounds",
    "scene": "from the user's numbers to the assembled model",
    "response": "what is asked of a state: fields, extremes, pressures, supports",
    "continuation": "from event to event, through limit points, over ground",
    "moving_load": "trains, what they make at most, influence lines",
    "cases": "many cases, side by side in wide registers, and combinations",
    "face": "objects for C, Fortran, Fortran 77, f2py: marshalling only",
    "yardsticks": "other methods, compiled for the studies",
}
"""The folders, each standing on those before it only."""
PYTHON = ("base", "packs", "engine", "scene", "results/views", "results/state", "results/paths", "results/envelopes",
          "results/trains", "results/cases", "results", "batches", "report", "plots", "html", "show", "studies", "cli")  # fmt: skip
ROOMS = {f"fortran/{name}": purpose for name, purpose in FORTRAN.items()} | {f"python/gapbeam/{name}": None for name in PYTHON}


def files_of(room):
    """Sources of a room, by name."""
    there = sorted((TOP / room).iterdir())
    return [path for path in there if path.suffix in (".f90", ".F90", ".inc", ".c", ".py") and not path.stem.startswith("__")]


def head_of(path, ends=".:"):
    """Give the first sentence of a source, by default no farther than to a colon."""
    text = path.read_text()
    if path.suffix == ".py":
        words = ast.get_docstring(ast.parse(text)) or ""
    elif path.suffix == ".c":
        words = re.sub(r"[/*]+", " ", text[: text.find("*/")])
    else:
        words = "\n".join(line.lstrip("!>").strip() for line in re.match(r"(?:!.*\n)*", text)[0].splitlines())
    paragraph = " ".join(words.strip().partition("\n\n")[0].split())
    return re.split(rf"(?<=[{ends}])\s", paragraph)[0].rstrip(ends)


def filled(words):
    """Break words into lines."""
    lines = [""]
    for word in words:
        if len(lines[-1]) + len(word) + 1 > WIDTH:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines


def lists():
    """Give the lists of all rooms, as lines."""
    lines = []
    for room, purpose in ROOMS.items():
        words = (purpose or head_of(TOP / room / "__init__.py")).split()
        names = sorted({f"`{path.stem}`" for path in files_of(room)})
        lines += filled([f"* **`{room}`**", words[0].lower(), *words[1:-1], f"{words[-1]}:", *names])
    return lines


def made():
    """Give the page with its lists as they should be."""
    before, _, rest = HOUSE.read_text().partition(BEGIN)
    return before + BEGIN + "\n" + "\n".join(lists()) + "\n\n" + END + rest.partition(END)[2]


def main(arguments):
    """Rewrite the page, or print the heads of the rooms that are named."""
    if not arguments:
        HOUSE.write_text(made())
    for room in arguments:
        if room not in ROOMS:
            sys.exit(f"no room {room}; the rooms are {', '.join(ROOMS)}")
        for path in files_of(room):
            print(textwrap.fill(head_of(path, "."), WIDTH, initial_indent=f"{path.stem:24} ", subsequent_indent=" " * 25))


if __name__ == "__main__":
    main(sys.argv[1:])
