"""How a scene is solved: load steps, events, histories."""

from __future__ import annotations

from typing import Literal

from msgspec import field

from .table import Count, Modes, Table


class Analysis(Table, forbid_unknown_fields=True, kw_only=True):
    """How the load is followed.

    Parameters
    ----------
    steps : int
        Number of equal steps of the load factor up to 1; default 1.
    follow : {"steps", "events"}
        steps (default), or events: every change of the acting supports at its exact load factor.
    rule : {"block", "single"}
        How the acting supports are found: block (default) changes many at once and always ends, single (the
        paper's rule) releases the one that pulls most and puts back all that are penetrated.
    at_limit : {"stop", "jump", "follow"}
        Where the load cannot grow any more, since supports soften or yield: stop (default); jump to the next stable state
        at the same load factor; or follow the path on, with falling load (only with follow = "events").
    history : list of float
        Load factors (no unit) gone through in turn, from event to event; default [1.0].
    first_order : bool
        True: axial loads are meant to have no effect on bending, also where compression is beyond the Euler load. Default
        false: bending feels them; where that is not available, a scene with such compression is refused.
    buckling : int
        How many factors by which all axial forces N must be multiplied for the beam to buckle are found, with the supports and the
        ground that act at the end; default 0.
    frequencies : int
        How many circular frequencies (rad per unit of time) are found likewise, with `beam.mass`; default 0.
    N_with : {"dead", "live"}
        What the given axial forces N belong to: dead (default), they are the same at all load factors; live, they grow with the
        load factor, from 0.
    stretching : bool
        True: what deflections lengthen the beam by pulls it, between two supports along its axis (cable effect); default false.
    """

    steps: Count = 1
    follow: Literal["steps", "events"] = "steps"
    rule: Literal["block", "single"] = "block"
    at_limit: Literal["stop", "jump", "follow"] = "stop"
    history: list[float] = field(default_factory=lambda: [1.0])
    first_order: bool = False
    buckling: Modes = 0
    frequencies: Modes = 0
    N_with: Literal["dead", "live"] = "dead"
    stretching: bool = False

    @property
    def has_history(self) -> bool:
        """Whether other load factors are gone to than the full load alone."""
        return self.history != [1.0]

    @property
    def is_one_step(self) -> bool:
        """Whether the full load is put on at once."""
        return self.follow == "steps" and self.steps == 1 and not self.has_history
