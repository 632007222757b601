"""Scenes whose beams taper, or turn in elastic hinges: those of other modules with other sections, or stiffer hinges."""

from .foundation import digits, part, rounded


def with_tapers(rng, made):
    """The same scene with one or two sections that taper, beside or over those that are there.

    Parameters
    ----------
    rng : random.Random
    made : dict
        With positive lengths; changed.

    Returns
    -------
    dict
    """
    length, least = sum(made["beam"]["spans"]), made["beam"]["EI"]
    least = min(least) if isinstance(least, list) else least
    sections = made.setdefault("sections", [])
    for _ in range(rng.choice((1, 1, 2))):
        start, end = (0.0, length) if rng.random() < 0.4 else part(rng, length)
        section = {"from": start, "to": end}
        if rng.random() < 0.85:
            section["EI"] = taper(rng, least)
        if "EI" not in section or "GA" in made["beam"] or rng.random() < 0.2:
            section["GA"] = taper(rng, made["beam"].get("GA", least * rounded(rng, 0.3, 30)))
        sections.append(section)
    return made


def with_joints(rng, made):
    """The same scene with a stiffness for each of its hinges, from nearly free to nearly rigid.

    Parameters
    ----------
    rng : random.Random
    made : dict
        Changed; without hinges as it is.

    Returns
    -------
    dict
    """
    if hinges := made["beam"].pop("hinges", ()):
        least, length = made["beam"]["EI"], sum(made["beam"]["spans"])
        size = (min(least) if isinstance(least, list) else least) / length
        made["hinges"] = [{"x": x, "stiffness": digits(size * 10 ** rng.uniform(-2, 3))} for x in hinges]
    return made


def taper(rng, size):
    """A stiffness that changes, mostly by less than ten times."""
    ends = [digits(size * rounded(rng, 0.5, 2)), digits(size * rounded(rng, 2, 20))]
    rng.shuffle(ends)
    return ends if rng.random() < 0.4 else {"from": ends[0], "to": ends[1], "power": rng.choice((1, 2, 3, 3, 4))}


def stiffness_along(value, section, x):
    """A stiffness of a section at places, an array."""
    if isinstance(value, dict):
        first, last, power = value["from"], value["to"], value.get("power", 1)
    elif isinstance(value, (list, tuple)):
        (first, last), power = value, 1
    else:
        return value
    share = (x - section["from"]) / (section["to"] - section["from"])
    return (first ** (1 / power) * (1 - share) + last ** (1 / power) * share) ** power
