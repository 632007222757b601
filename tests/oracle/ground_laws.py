"""What ground presses back with, law by law, along a beam whose deflections are given."""

import numpy as np
from scenes import nodes_of
from scenes.tabled import is_table

SIDES = {"below": (1,), "above": (-1,), "both": (1, -1)}


def between(values, x, item, length):
    """A number, a line from one end of an item to the other, or a table."""
    if is_table(values):
        return np.interp(x, *zip(*values, strict=True))
    if not isinstance(values, list | tuple):
        return np.full_like(x, values)
    a, b = item.get("from", 0.0), item.get("to", length)
    return values[0] + (values[1] - values[0]) * (x - a) / (b - a)


def pressure(made, x, w):
    """Force of the ground per length, up."""
    total, length = np.zeros_like(x), nodes_of(made)[-1]
    for item in made["foundation"]:
        gap = between(item.get("gap", 0.0), x, item, length)
        if "profile" in item:
            gap = np.interp(x, *zip(*item["profile"], strict=True))
        there = (x >= item.get("from", 0.0)) & (x <= item.get("to", length))
        linear = not np.any(gap) and "law" not in item and item.get("side", "both") == "both"
        for side in SIDES[item.get("side", "both")]:
            u = side * w - gap
            total += np.where(there & ((u > 0.0) | linear), side * by_law(item, x, u, length), 0.0) * (0.5 if linear else 1.0)
    return total


def by_law(item, x, u, length):
    """Force of a law pressed in by u."""
    law = item.get("law")
    if law is None:
        return between(item["k"], x, item, length) * u
    if isinstance(law, list) and isinstance(law[0], dict):
        return by_polylines(law, x, u)
    if isinstance(law, list):
        d, r = (np.array([0.0, *column]) for column in zip(*law, strict=True))
        beyond = (r[-1] - r[-2]) / (d[-1] - d[-2]) * np.maximum(u - d[-1], 0.0)
        return np.interp(u, d, r) + beyond
    parameters = {key: between(value, x, item, length) for key, value in law.items() if key != "type"}
    if law["type"] == "cubic":
        return u * (parameters["k1"] + u * (parameters.get("k2", 0.0) + u * parameters["k3"]))
    k, limit = parameters["stiffness"], parameters["limit"]
    if law["type"] in ("plastic", "hardening"):
        return np.where(k * u <= limit, k * u, limit + parameters.get("slope", 0.0) * (u - limit / np.where(k > 0.0, k, 1.0)))
    share = np.divide(k * u, limit, out=np.zeros_like(u), where=limit > 0.0)
    return k * u / (1.0 + share) if law["type"] == "hyperbolic" else limit * np.tanh(share)


def by_polylines(law, x, u):
    """Force of a law whose points are straight between places."""
    places = [at["x"] for at in law]
    points = np.array([[(0.0, 0.0), *at["points"]] for at in law])  # places by points by 2
    d, r = (np.array([np.interp(x, places, column) for column in points[:, :, k].T]) for k in (0, 1))
    slopes = np.diff(r, axis=0) / np.diff(d, axis=0)
    piece = np.clip((u >= d).sum(axis=0) - 1, 0, len(slopes) - 1)
    at = np.arange(len(x))
    return r[piece, at] + slopes[piece, at] * (u - d[piece, at])
