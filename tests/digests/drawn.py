"""The scenes: those of the tree, and those that the families of the attack draw by seed."""

import json
import tomllib
from pathlib import Path

from attack import batches, combinations, doubled, enumeration, events, ground, hinges, laws, signs, trains

TOP = Path(__file__).resolve().parents[2]
FAMILIES = {module.FAMILY.name: module.FAMILY for module in (
    batches, combinations, doubled, enumeration, events, ground, hinges, laws, signs, trains)}  # fmt: skip


def read(path):
    """A scene as its file has it."""
    return tomllib.loads(path.read_text()) if path.suffix == ".toml" else json.loads(path.read_text())


def scenes_of_files(folders):
    """Name and scene of every example and of every fault that was mended.

    Parameters
    ----------
    folders : sequence of str
        Where they are.
    """
    for folder in folders:
        for path in sorted((TOP / folder).glob("*.*")):
            if path.suffix in (".toml", ".json"):
                yield path.stem, read(path)


def scenes_of_families(count):
    """Name and scene of so many cases of the attack, the families in equal parts.

    Parameters
    ----------
    count : int
    """
    for name, family in FAMILIES.items():
        for seed in range(-(-count // len(FAMILIES))):
            yield f"{name} {seed}", family.draw(seed)[1]


def write_scenes(count, path, folders=("examples", "tests/faults")):
    """Write all scenes, so that both commits solve the same ones.

    Parameters
    ----------
    count : int
        Of those that are drawn.
    path : Path
    folders : sequence of str, optional
        Of those that have files.

    Returns
    -------
    int
        How many there are.
    """
    scenes = [*scenes_of_files(folders), *scenes_of_families(count)]
    path.write_text("".join(json.dumps(pair) + "\n" for pair in scenes))
    return len(scenes)
