"""The JSON Schema of results: every key of the JSON output with its type, meaning, unit and sign.

`gapbeam.results.data` and its neighbours write that output. Tests hold what they write of every example against this.
"""

from __future__ import annotations

from typing import Any

from ..engine.quantities import QUANTITIES
from .data import SCHEMA
from .state.breakpoints import OF_SUPPORTS, OF_ZONES

WORDS = {
    "Schema": [SCHEMA],
    "Status": ["solved", "no-equilibrium", "buckles", "limit-load", "indeterminate", "not-converged", "not-finite"],
    "Side": ["both", "below", "above", "left", "right", "counterclockwise", "clockwise", "sagging", "hogging"],
    "Normal": ["normal", "axial", "rotational", "hinge"],
    "Way": ["right", "left"],
}
"""Keys that hold one of some words."""


def _along(of: str) -> dict[str, tuple[str, str]]:
    """Give a key for every field along the beam."""
    return {f"{one.name}?": (of, one.meaning) for one in QUANTITIES}


def _names(events: dict[int, tuple[str, str]]) -> str:
    """Give the names of events."""
    return ", ".join(name for name, _ in events.values())


STATE = {
    "factor?": ("number", "Load factor of all cases but dead."),
    "path?": ("number", "Length of the path up to here, in load factors; only where a path is followed."),
    "stable?": ("boolean", "Whether the state is stable; only where a path is followed."),
    "exact?": ("boolean", "false where the end of the path was found to limited accuracy only."),
    "solves?": ("integer", "Linear systems solved."),
    "seconds?": ("number", "Time taken (s)."),
    "supports?": ("[SupportState]", "Supports."),
    "hinges?": ("[HingeState]", "Hinges with a stiffness."),
    "contact?": ("[ContactZone]", "Zones of contact with the ground; only with foundations."),
    "free_spans?": ("[FreeSpan]", "Spans without contact; only with foundations."),
    "slip_zones?": ("[SlipZone]", "Where the beam slides over ground along its axis; where that is rigid, or has slid last."),
    "undecided?": ("[integer]", "Supports whose state the last digits of the data decide, by number."),
    "indifferent?": ("boolean", "true where the beam is in neutral equilibrium: forces are unique, its position is not."),
    "unique?": ("boolean", "false where under compression other stable states are not excluded; else left out."),
    "certificate?": ("Certificate", "Residuals and error bounds."),
}
"""Keys of a state. Those that end in ? may be left out."""

NAME = {"name?": ("string", "Its name, where it has one.")}
ENDS = {"from": ("number", "Left end (length)."), "to": ("number", "Right end (length).")}
FOUNDATION = {"foundation": ("integer", "Number of the foundation, from 0.")}
OF = {
    "support?": ("integer", "Number of the support, from 0; or"),
    "foundation?": ("integer", "number of the foundation."),
} | NAME  # fmt: skip
"""Keys that several tables have."""

MOTION = "Mechanism of an unstable beam, or the mode in which it buckles: position and deflection, in any scale."
MODES = {
    "buckling?": ("[number]", "Factors by which all axial forces N must be multiplied for the beam to buckle as it stands at the "
                              "end; only with analysis.buckling."),
    "frequencies?": ("[number]", "Circular frequencies of the beam as it stands at the end (rad per unit of time); only with "
                                 "analysis.frequencies."),
}  # fmt: skip
"""Keys of modes."""

TABLES: dict[str, tuple[str, dict[str, tuple[str, str]]]] = {
    "ResultUnits": ("Labels of the units, as in the scene.", {
        "force": ("string", "Unit of force."),
        "length": ("string", "Unit of length."),
    }),
    "Compression": ("The largest compression of the beam beside its Euler load.", {
        "ratio": ("number | null", "P L^2/(pi^2 EI); null where it has no bound."),
        "force": ("number", "Compression (force)."),
        "from": ("number", "Left end of the compressed length (length)."),
        "to": ("number", "Right end of the compressed length (length)."),
        "length": ("number | null", "Buckling length (length)."),
    }),
    "ResultSystem": ("The system of equations of the last step.", {
        "nodes": ("integer", "Beam ends, supports and hinges; with foundations also ends of the zones of contact."),
        "unknowns": ("integer", "Unknowns in bending."),
        "half_bandwidth": ("integer", "Half bandwidth of the system."),
        "method": ("string", "How it was solved."),
        "axial_unknowns": ("integer", "Unknowns along the beam."),
        "left_out": ("[string]", "What this scene does not need, such as shear."),
        "compression?": ("Compression", "Largest compression; only where the beam is compressed."),
    }),
    "SupportState": ("A support in one state, in the order of the scene.", NAME | {
        "x": ("number", "Position (length, from the left end of the beam)."),
        "side": ("Side", "Side on which it holds the beam, as in the scene."),
        "direction": ("Normal", "Direction, as in the scene."),
        "at_hinge?": ("Way", "On which side of a hinge it holds the rotation; only of one that does."),
        "deflection": ("number", "Deflection of the beam there (length), positive downward; of an axial support to the right; the "
                                 "rotation (rad) of what holds one, clockwise, of a hinge that left of it less that right of it."),
        "reaction": ("number", "Force of the support on the beam (force), positive upward; of an axial one to the right; the "
                               "couple of what holds a rotation, counterclockwise, of a hinge its sagging moment."),
        "couple": ("number", "Moment of its rotational restraint on the beam (force*length), positive clockwise."),
        "state": ("string", "closed, open, bilateral, or of a support with a curve the segment of it: branch 1, branch 2, ..."),
        "opening": ("number", "Distance of the beam from its seat, the gap included (length); 0 in contact."),
        "set?": ("number", "Displacement that is left without force (length, of a rotation rad): of one side where it gives way, "
                 "else as deflections are positive; only with plastic unloading."),
        "dissipated?": ("number", "Energy lost up to here on a loading history (force*length); only with plastic unloading, and "
                                  "with friction."),
        "axial?": ("Friction", "Along the beam; only of a support with friction."),
    }),
    "Friction": ("What friction does at a support.", {
        "force": ("number", "Force on the beam (force), positive to the right."),
        "slip": ("number", "How far the beam has gone over the support (length), positive to the right."),
        "slides": ("string", "Which way it slides, left or right; empty where it sticks."),
    }),
    "HingeState": ("A hinge with a stiffness in one state.", {
        "x": ("number", "Position (length, from the left end of the beam)."),
        "moment": ("number", "Moment there (force*length), sagging."),
        "rotation": ("number", "Rotation left of it less that right of it (rad): moment over stiffness."),
    }),
    "SlipZone": ("A length of the beam that slides over ground along its axis; where that is rigid, or has slid last.", ENDS | {
        "way": ("string", "Which way the beam goes, or went: right or left."),
        "friction": ("number", "Force of the ground on the beam along it (force), positive to the right."),
    }),
    "ContactZone": ("A length of the beam in contact with the ground.", FOUNDATION | NAME | ENDS | {
        "state": ("string", "closed, bilateral, or the segment of the ground's curve: branch 1, ..."),
        "resultant": ("number", "Total reaction of the ground there (force), positive upward. A point force of rigid ground has "
                                "from equal to to."),
    }),
    "FreeSpan": ("A length of the beam above the ground without contact.", FOUNDATION | ENDS | {
        "sag": ("number", "Largest clearance above the ground (length)."),
    }),
    "Certificate": ("Residuals and error bounds, each relative to the largest value of its kind.", {
        "equilibrium": ("number", "Residual of equilibrium."),
        "compatibility": ("number", "Residual of compatibility."),
        "complementarity": ("number", "Residual of contact: opening times reaction."),
        "error_bound": ("number | null", "Bound of the relative error of deflections and reactions; null: none is known."),
        "error_bound_deflection": ("number | null", "Bound for deflections; null: none is known."),
        "error_bound_rotation": ("number | null", "Bound for rotations; null: none is known."),
        "error_bound_moment": ("number | null", "Bound for moments; null: none is known."),
        "error_bound_shear": ("number | null", "Bound for shear forces; null: none is known."),
        "error_bound_reaction": ("number | null", "Bound for reactions; null: none is known."),
    }),
    "StepState": ("One state of the beam.", STATE),
    "Event": ("A change of the contact state at its exact load factor.", {
        "factor": ("number", "Load factor."),
        **OF,
        "x": ("number", "Position (length)."),
        "event": ("string", f"{_names(OF_SUPPORTS)}; of the ground {_names(OF_ZONES)}."),
        "branch?": ("integer", "Number of the equilibrium branch, from 2 on."),
    }),
    "TrainEvent": ("A change of the contact state at the exact position of a train.", {
        "position": ("number", "Position of the first axle (length)."),
        **OF,
        "x": ("number", "Position of the change (length)."),
        "event": ("string", "As for load factors."),
        "branch?": ("integer", "Number of the equilibrium branch, from 2 on."),
        "direction": ("Way", "Way the train goes."),
    }),
    "UnstablePositions": ("Positions of a train that are not solved.", {
        "from": ("number", "First position (length)."),
        "to": ("number", "Last position (length)."),
        "status": ("Status", "What they are."),
        "reason": ("string", "Why, in words."),
        "direction": ("Way", "Way the train goes."),
    }),
    "TrainOnBeam": ("A train on its way, in one combination.", {
        "name": ("string", "Name of the train."),
        "combination?": ("string", "Name of the combination; only with combinations."),
        "case": ("string", "Its load case."),
        "events": ("[TrainEvent]", "Changes of the contact state."),
        "gaps": ("[UnstablePositions]", "Positions without an answer."),
        "solves": ("integer", "Linear systems solved."),
    }),
    "Landing": ("The stable state after a limit load.", {
        "factor": ("number", "Load factor."),
        "released": ("number", "Energy set free by the jump (force*length)."),
        "supports": ("[SupportState]", "Supports there."),
    }),
    "LimitLoad": ("The first limit of the load.", {
        "factor": ("number", "Load factor that cannot be exceeded."),
        "kind": ("string", "limit, or another end of the path."),
        "exact?": ("boolean", "false where it was found to limited accuracy only."),
        "landing": ("Landing | null", "The next stable state at that load factor; null where there is none."),
    }),
    "Source": ("Where a value comes from, and what else is there at the same time.", {
        "combination?": ("string", "Name of the combination."),
        "train?": ("string", "Name of the train."),
        "position?": ("number", "Position of the train (length)."),
        "direction?": ("Way", "Way the train goes."),
        "factor?": ("number", "Load factor."),
        "leg?": ("integer", "Which entry of analysis.history was gone to, from 0; -1 while the dead loads were put on."),
        "x?": ("number", "Position along the beam (length)."),
        "side?": ("Way", "Side of the position on which it is, where the field jumps."),
        "from?": ("number", "Left end of the free span (length)."),
        "to?": ("number", "Right end of the free span (length)."),
        "sag?": ("number", "Its largest clearance (length)."),
        "reason?": ("string", "Why there is no value."),
        "ties?": ("[Source]", "Other sources of the same value."),
        "concurrent?": ("{number}", "Other quantities in the same state at the same place."),
    }),
    "Lifted": ("A one-sided support without contact, where its opening is largest.", {
        "support": ("integer", "Number of the support, from 0."),
        "name?": ("string", "Its name, where it has one."),
        "opening": ("number", "Distance of the beam from its seat, the gap included (length)."),
        "factor?": ("number", "Load factor."),
        "combination?": ("string", "Name of the combination."),
        "train?": ("string", "Name of the train."),
        "position?": ("number", "Position of the train (length)."),
    }),
    "Utilisation": ("A limit of the scene beside the largest value.", {
        "value": ("number", "The value, with its sign."),
        "limit": ("number", "What is allowed."),
        "ratio": ("number", "Absolute value over limit; above 1 it is exceeded."),
        "x": ("number", "Position (length)."),
        "support?": ("integer", "Number of the support it belongs to."),
        "combination?": ("string", "Name of the combination."),
        "train?": ("string", "Name of the train."),
        "position?": ("number", "Position of the train (length)."),
        "direction?": ("Way", "Way the train goes."),
        "factor?": ("number", "Load factor."),
        "leg?": ("integer", "Which entry of analysis.history."),
    }),
    "Range": ("Largest and smallest value.", {
        "max": ("[number | Source]", "Value, along the beam its position, in envelopes its source; empty: not solved."),
        "min": ("[number | Source]", "As max."),
    }),
    "SpanRange": ("Longest and deepest span without contact.", {
        "longest?": ("[number | Source]", "Length and source."),
        "deepest?": ("[number | Source]", "Clearance and source."),
    }),
    "SupportRange": ("Largest and smallest values of a support.", {
        "support?": ("integer", "Its number, from 0."),
        "name?": ("string", "Its name, where it has one."),
        "reaction?": ("Range", "Reaction (force), positive upward."),
        "opening?": ("Range", "Opening (length)."),
        "deflection?": ("Range", "Deflection (length), positive downward."),
        "couple?": ("Range", "Moment of its rotational restraint (force*length), positive clockwise."),
    }),
    "FoundationRange": ("Largest and smallest values of a foundation.", NAME | {
        "resultant": ("Range", "Total reaction of the ground (force), positive upward."),
        "free_span": ("SpanRange", "Spans without contact."),
    }),
    "Curves": ("Largest and smallest values at every position, and what they come from.", {
        "max": ("[number | null]", "Largest values; null where nothing is solved."),
        "min": ("[number | null]", "Smallest values."),
        "max_of?": ("[integer]", "Number of the combination with the largest value, from 0."),
        "min_of?": ("[integer]", "Number of the combination with the smallest value."),
        "max_at?": ("[number | null]", "Position of the train for the largest value (length)."),
        "min_at?": ("[number | null]", "Position of the train for the smallest value."),
    }),
    "Extremes": ("Largest and smallest values along the beam, by field.", _along("Range")),
    "FieldColumns": ("Columns of numbers along the beam.", {"x": ("[number]", "Positions (length).")} | _along("[number]")),
    "EnvelopeFields": ("Envelope curves along the beam.", {"x": ("[number]", "Positions (length).")} | _along("Curves")),
    "Envelope": ("Largest and smallest values over all combinations and positions of trains.", {
        "supports": ("[SupportRange]", "Supports, in the order of the scene."),
        "foundations?": ("[FoundationRange]", "Foundations, in the order of the scene."),
        "extremes": ("Extremes", "Along the beam: value, position, source."),
        "fields": ("EnvelopeFields", "Curves along the beam."),
    }),
    "HistoryExtremes": ("Largest and smallest values over the whole loading history.", _along("Range") | {
        "over": ("string", "What is looked at: steps, path or history."),
        "supports": ("[SupportRange]", "Supports, in the order of the scene."),
        "missing?": ("[Source]", "States that could not be solved."),
    }),
    "CombinationResult": ("A combination in its own contact state; of several states the last one.", STATE | MODES | {
        "name": ("string", "Its name."),
        "limit_state?": ("string", "Name of its limit state; only where it has one."),
        "status": ("Status", "Its outcome."),
        "reason?": ("string | null", "Why it is not solved, in words."),
        "motion?": ("[[number]] | null", MOTION),
        "without_trains?": ("string", "Why the beam is unstable while no train is on it."),
        "limit?": ("LimitLoad", "First limit of the load."),
        "events?": ("[Event]", "Changes; with follow = \"events\"."),
        "compression?": ("Compression", "Largest compression; only where the beam is compressed."),
        "steps?": ("[StepState]", "All states, where there are several."),
        "extremes?": ("Extremes", "Exact extremes along the beam: value and position."),
    }),
    "Results": ("The JSON output of a scene.", MODES | {
        "schema": ("Schema", "Name and version of this form; it changes when programs that read it have to."),
        "title": ("string", "Title of the scene."),
        "units": ("ResultUnits", "Labels of the units."),
        "status": ("Status", "Outcome; with combinations the worst."),
        "reason?": ("string | null", "Why it is not solved, in words."),
        "motion?": ("[[number]] | null", MOTION),
        "remarks?": ("[string]", "What one should know about the answer."),
        "system?": ("ResultSystem", "The system of equations; without combinations."),
        "compression?": ("Compression", "Largest compression; with combinations."),
        "steps?": ("[StepState]", "States at the load factors gone to; without combinations."),
        "limit?": ("LimitLoad", "First limit of the load."),
        "events?": ("[Event]", "Changes of the contact state; with follow = \"events\"."),
        "lifted?": ("[Lifted]", "Supports without contact."),
        "utilisations?": ("{Utilisation}", "Limits of the scene and how far they are used, by quantity."),
        "fields?": ("FieldColumns", "Columns along the beam at the last state; where a field jumps, x is there twice."),
        "extremes?": ("Extremes", "Exact extremes along the beam at the last state: value and position."),
        "history_extremes?": ("HistoryExtremes", "Extremes over the whole loading history."),
        "trains?": ("[TrainOnBeam]", "Trains on their way."),
        "without_trains?": ("string", "Why the beam is unstable while no train is on it."),
        "combinations?": ("[CombinationResult]", "Combinations, in the order of the scene."),
        "envelope?": ("Envelope", "Envelope; with combinations or trains."),
        "envelopes?": ("{Envelope}", "Envelopes of the combinations of each limit state, by its name."),
    }),
}
"""Tables of the output: purpose; by key its type and meaning. [] is a list, {} a table by name, | one of several."""


def result_schema() -> dict[str, Any]:
    """JSON Schema of results, for programs that read the JSON output.

    Returns
    -------
    dict
        For `json.dumps`. Its title is the version that stands in the output as ``schema``.

    Examples
    --------
    >>> result_schema()["$defs"]["SupportState"]["properties"]["side"]["description"]
    'Side on which it holds the beam, as in the scene.'
    """
    tables = {
        name: {
            "type": "object",
            "description": purpose,
            "properties": {key.rstrip("?"): {**_type(of), "description": text} for key, (of, text) in keys.items()},
            "required": [key for key in keys if not key.endswith("?")],
            "additionalProperties": False,
        }
        for name, (purpose, keys) in TABLES.items()
    }
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": SCHEMA, "$ref": "#/$defs/Results", "$defs": tables}


def _type(of: str) -> dict[str, Any]:
    """Give the schema of a type as it is written in the tables."""
    if of.startswith("[") and of.endswith("]"):
        return {"type": "array", "items": _type(of[1:-1])}
    if of.startswith("{"):
        return {"type": "object", "additionalProperties": _type(of[1:-1])}
    if " | " in of:
        return {"anyOf": [_type(one) for one in of.rsplit(" | ", 1)]}
    if of in WORDS:
        return {"enum": WORDS[of]}
    return {"$ref": f"#/$defs/{of}"} if of in TABLES else {"type": of}
