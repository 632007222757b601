"""The installed library called through its C and its Fortran 77 interface, by ctypes, for scenes as dicts."""

import ctypes as c
import math
import sys
from typing import NamedTuple

import numpy as np

SIDES = {
    "both": 0, "below": 1, "above": -1, "left": 1, "right": -1, "counterclockwise": 1, "clockwise": -1, "sagging": 1,
    "hogging": -1,
}  # fmt: skip
DIRECTIONS = ("normal", "axial", "rotational", "hinge")
KINDS = {"force": 1, "moment": 2, "uniform": 3, "linear": 3, "curvature": 4, "axial": 5, "movement": 6, "temperature": 7,
         "axial_uniform": 11}  # fmt: skip


def special_kind(load):
    """8: a movement that is a rotation; 12: one of a foundation; 9, 10: couples left, right of a hinge; 13: a linear curvature."""
    if isinstance(load.get("kappa"), list):
        return 13
    if load["type"] == "movement" and "support" not in load:
        return 12
    return 8 if "rotation" in load else {"left": 9, "right": 10}.get(load.get("at_hinge"))


def direction(support):
    """4 and 5: left and right of a hinge."""
    return {"left": 4, "right": 5}.get(support.get("at_hinge"), 0) or DIRECTIONS.index(support.get("direction", "normal"))


RULES = {"block": 0, "single": 1}
GROUND_LAWS = {
    "plastic": (1, ("stiffness", "limit")),
    "hardening": (2, ("stiffness", "limit", "slope")),
    "hyperbolic": (3, ("stiffness", "limit")),
    "tanh": (4, ("stiffness", "limit")),
    "cubic": (5, ("k1", "k2", "k3")),
}
UNLOADING = {"elastic": 0, "plastic": 1, "broken": 2}
AT_LIMIT = {"stop": 0, "jump": 1, "follow": 2}
CHANGES = {0: "opens", 1: "closes", 3: "turns", 4: "yields", 5: "hardens", 6: "softens", 7: "breaks", 8: "unloads"} | {
    9: "slips", 10: "sticks"
}
KINDS_OF_LIMIT = {1: "limit", 2: "bifurcation", 3: "mechanism"}
ENDINGS = {0: "", 3: "mechanism", 4: "ended"}
REAL, INTEGER = c.POINTER(c.c_double), c.POINTER(c.c_int)


SUPPORT_LAWS = {
    None: (0, ()), "plastic": (1, ("stiffness", "limit")), "hardening": (2, ("stiffness", "limit", "slope")),
    "hyperbolic": (3, ("stiffness", "limit")), "tanh": (4, ("stiffness", "limit")), "cubic": (5, ("k1", "k2", "k3")),
    "power": (7, ("d0", "limit", "n")), "brittle": (8, ("stiffness", "limit")),
}  # fmt: skip


class Model(c.Structure):
    """gapbeam_model of the header."""

    _fields_ = (
        ("size", c.c_size_t),
        ("spans", c.c_int),
        *((name, REAL) for name in ("length", "EI", "GA", "EA")),
        ("hinges", c.c_int),
        ("hinge_x", REAL),
        ("supports", c.c_int),
        ("support_x", REAL),
        ("support_node", INTEGER),
        ("support_side", INTEGER),
        *((f"support_{name}", REAL) for name in ("stiffness", "gap", "settlement", "rotation")),
        ("support_direction", INTEGER),
        ("loads", c.c_int),
        ("load_kind", INTEGER),
        ("load_case", INTEGER),
        ("load_x", REAL),
        ("load_node", INTEGER),
        *((f"load_{name}", REAL) for name in ("to", "value", "value_to")),
        ("support_unloading", INTEGER),
        ("law_points", c.c_int),
        ("law_support", INTEGER),
        *((f"law_{name}", REAL) for name in ("displacement", "force")),
        ("foundations", c.c_int),
        *((f"foundation_{name}", REAL) for name in ("from", "to")),
        ("foundation_side", INTEGER),
        *((f"foundation_{name}", REAL) for name in ("k", "k_to", "gap", "gap_to")),
        ("profile_points", c.c_int),
        ("profile_foundation", INTEGER),
        *((f"profile_{name}", REAL) for name in ("x", "gap")),
        ("ground_law_points", c.c_int),
        ("ground_law_foundation", INTEGER),
        *((f"ground_law_{name}", REAL) for name in ("displacement", "force")),
        ("foundation_law", INTEGER),
        *((f"foundation_{name}", REAL) for name in ("parameter", "parameter_to")),
        ("table_points", c.c_int),
        *((f"table_{name}", INTEGER) for name in ("foundation", "quantity")),
        *((f"table_{name}", REAL) for name in ("x", "value")),
        ("support_law", INTEGER),
        ("support_parameter", REAL),
        ("support_friction", REAL),
        ("hinge_stiffness", REAL),
        *((name, REAL) for name in ("N", "mass", "foundation_shear")),
        *((name, c.c_int) for name in ("N_grows", "first_order", "stretching", "with_trains", "masses")),
        *((name, REAL) for name in ("mass_x", "lumped_mass")),
        ("sections", c.c_int),
        *((f"section_{name}", REAL) for name in ("from", "to", "EI", "GA", "EA", "EI_to", "GA_to", "EA_to")),
        *((f"section_{name}_power", INTEGER) for name in ("EI", "GA", "EA")),
        *((f"section_{name}", REAL) for name in ("friction", "N", "friction_to", "bedding")),
    )


class Options(c.Structure):
    """gapbeam_options of the header."""

    _fields_ = (("size", c.c_size_t), ("rule", c.c_int), ("reserved", c.c_int))


class Info(c.Structure):
    """gapbeam_info of the header."""

    _fields_ = (
        ("size", c.c_size_t),
        ("factor", c.c_double),
        *((name, c.c_int) for name in ("status", "solves", "method", "indifferent", "slides", "unique")),
    )


class Certificate(c.Structure):
    """gapbeam_certificate of the header."""

    _fields_ = (
        ("size", c.c_size_t),
        *((n, c.c_double) for n in ("equilibrium", "compatibility", "complementarity", "deflection_bound", "reaction_bound")),
        ("field_bound", c.c_double * 4),
        ("known", c.c_int),
        ("reserved", c.c_int),
    )


class HistoryInfo(c.Structure):
    """gapbeam_history_info of the header."""

    _fields_ = (
        ("size", c.c_size_t),
        *((name, c.c_int) for name in ("stretches", "events", "limits", "ending", "solves", "nodes")),
    )


class History(NamedTuple):
    """A history, as plain lists; everything counts from 0.

    Attributes
    ----------
    along : numpy.ndarray
        Load factors at the ends of the stretches.
    about : numpy.ndarray of int
        Leg, direction, stable, index, ways, skipped of every stretch.
    events : list of (float, int, str)
        Load factor, support, what happens.
    limits : list of (float, str, int, int, bool)
        Load factor, kind, leg, landing, whether it is on the smooth laws.
    exact : list of bool
        Whether the ends of the stretches are on the smooth laws.
    ending : str
    """

    along: np.ndarray
    about: np.ndarray
    events: list
    limits: list
    exact: list
    ending: str


def with_rotations(scene):
    """A scene in which restraints and hinges with laws are supports of their own."""
    supports, held = [], []
    for k, support in enumerate(scene["supports"]):
        given = support.get("rotation")
        if "at_hinge" in support and given is not None and not isinstance(given, dict):
            given = {"stiffness": math.inf if given == "fixed" else given}
        left = {"rotation", "at_hinge"} if isinstance(given, dict) else ()
        supports.append({key: value for key, value in support.items() if key not in left})
        if isinstance(given, dict):
            place = {key: support[key] for key in ("x", "node", "at_hinge") if key in support}
            held.append({**place, **given, "direction": "rotational", "name": f"rotation of {support.get('name', k)}"})
    beside = any("at_hinge" in support for support in scene["supports"])
    more = [hinge for hinge in scene.get("hinges", ()) if beside or set(hinge) & {"slack", "side", "law", "unloading"}]
    held += [{**hinge, "direction": "hinge"} for hinge in more]
    for one in held:
        one["gap"] = one.pop("slack", 0.0)
        if one["gap"] and one.get("side", "both") == "both" and "law" not in one:
            stiffness = one.pop("stiffness", math.inf)
            one["law"] = [[0.0, 1.0] if math.isinf(stiffness) else [1.0, stiffness]]
    return {**scene, "supports": supports + held, "hinges": [hinge for hinge in scene.get("hinges", ()) if hinge not in more]}


UNCHANGED = -sys.float_info.max


def friction_of(ground):
    """A section for ground along the beam."""
    limit = ground.get("limit", np.inf)
    ends = dict(zip(("friction", "friction_to"), limit, strict=True)) if isinstance(limit, list) else {"friction": limit}
    return {**ground, **ends, "bedding": ground.get("stiffness", np.inf)}


def sections_of(scene):
    """The arrays of sections, with ground along the beam."""
    rows = [*scene.get("sections", ()), *map(friction_of, scene.get("axial_ground", ()))]
    found = {f"section_{key}": np.array([row.get(key, UNCHANGED) for row in rows], dtype=float) for key in ("to", "N")}
    for key, default in (("from", 0.0), ("friction", 0.0), ("friction_to", UNCHANGED), ("bedding", np.inf)):
        found[f"section_{key}"] = np.array([row.get(key, default) for row in rows], dtype=float)
    for key in ("EI", "GA", "EA"):
        given = [row.get(key, UNCHANGED) for row in rows]
        given = [dict(zip(("from", "to"), one, strict=True)) if isinstance(one, list) else one for one in given]
        tapers = [one if isinstance(one, dict) else {"from": one} for one in given]
        found[f"section_{key}"] = np.array([one["from"] for one in tapers], dtype=float)
        found[f"section_{key}_to"] = np.array([one.get("to", UNCHANGED) for one in tapers], dtype=float)
        found[f"section_{key}_power"] = np.array([one.get("power", 1) for one in tapers], dtype=np.int32)
    return found


def columns(scene):
    """The arrays of the C interface for a scene."""
    scene = with_rotations(scene)
    spans, supports, loads = scene["beam"]["spans"], scene["supports"], scene["loads"]
    end = math.fsum(scene["beam"]["spans"])

    def real(rows, key, default):
        return np.array([default if row.get(key) is None else row[key] for row in rows], dtype=float)

    def spread(key, default=math.inf):
        return np.broadcast_to(np.array(scene["beam"].get(key, default), dtype=float), len(spans)).copy()

    def number_of(load):
        found = load.get("support", load.get("node"))
        if found is None:
            return load.get("foundation", -1)
        return [support.get("name") for support in supports].index(found) if isinstance(found, str) else found

    def values(load):
        if load["type"] == "temperature":  # of one beam.alpha and depth
            alpha, depth = scene["beam"]["alpha"], scene["beam"].get("depth", 1.0)
            return [-alpha * load.get("gradient", 0.0) / depth, alpha * load.get("dT", 0.0)]
        value = next(load[key] for key in ("F", "M", "q", "kappa", "value", "rotation") if key in load)
        return value if isinstance(value, list) else [value, value]

    laws = [support.get("law") or () for support in supports]
    law = [(k, *point) for k, given in enumerate(laws) if not isinstance(given, dict) for point in given]
    named = [given if isinstance(given, dict) else {"type": None} for given in laws]
    codes = [SUPPORT_LAWS[given["type"]] for given in named]
    turns = {"free": 0.0, "fixed": math.inf}
    both = np.array([values(load) for load in loads], dtype=float).reshape(len(loads), 2)
    return {
        "length": np.array(spans, dtype=float),
        **{key: spread(key) for key in ("EI", "GA", "EA")},
        **{key: spread(key, 0.0) for key in ("N", "mass")},
        "N_grows": int(scene.get("analysis", {}).get("N_with") == "live"),
        "first_order": int(scene.get("analysis", {}).get("first_order", False)),
        "stretching": int(scene.get("analysis", {}).get("stretching", False)),
        "with_trains": int(bool(scene.get("trains"))),
        "mass_x": np.array([one["x"] for one in scene.get("masses", ())], dtype=float),
        "lumped_mass": np.array([one["mass"] for one in scene.get("masses", ())], dtype=float),
        **sections_of(scene),
        "hinge_x": np.array([*scene["beam"].get("hinges", []), *(one["x"] for one in scene.get("hinges", ()))], dtype=float),
        "hinge_stiffness": np.array(
            [0.0 for _ in scene["beam"].get("hinges", [])] + [one["stiffness"] for one in scene.get("hinges", ())], dtype=float
        ),
        "support_x": real(supports, "x", 0.0),
        "support_node": real(supports, "node", -1).astype(np.int32),
        "support_side": np.array([SIDES[s.get("side", "both")] for s in supports], dtype=np.int32),
        "support_stiffness": real(supports, "stiffness", math.inf),
        "support_gap": real(supports, "gap", 0.0),
        "support_settlement": real(supports, "settlement", 0.0),
        "support_rotation": np.array([turns.get(s.get("rotation", "free"), s.get("rotation")) for s in supports], dtype=float),
        "support_direction": np.array([direction(s) for s in supports], dtype=np.int32),
        "load_kind": np.array([special_kind(load) or KINDS[load["type"]] for load in loads], dtype=np.int32),
        "load_case": np.array([load.get("case") == "dead" for load in loads], dtype=np.int32),
        "load_x": np.array([load.get("x", load.get("from", 0.0)) or 0.0 for load in loads], dtype=float),
        "load_node": np.array([number_of(load) for load in loads], dtype=np.int32),
        "load_to": real(loads, "to", end),
        "load_value": both[:, 0].copy(),
        "load_value_to": both[:, 1].copy(),
        "support_unloading": np.array([UNLOADING[s.get("unloading", "elastic")] for s in supports], dtype=np.int32),
        "law_support": np.array([k for k, *_ in law], dtype=np.int32),
        "law_displacement": np.array([d for _, d, _ in law], dtype=float),
        "law_force": np.array([f for *_, f in law], dtype=float),
        "support_law": np.array([code for code, _ in codes], dtype=np.int32),
        "support_parameter": np.array(
            [([given.get(key, 0.0) for key in keys] + [np.nan] * 3)[:3] for given, (_, keys) in zip(named, codes, strict=True)],
            dtype=float,
        ).reshape(-1, 3),
        "support_friction": real(supports, "friction", 0.0),
        **ground_columns(scene.get("foundation", ()), end),
    }


def ground_columns(foundations, end):
    """The arrays of the C interface for foundations."""
    ends = {key: [np.broadcast_to(number(f.get(key, 0.0)), 2) for f in foundations] for key in ("k", "gap")}
    made = {
        "foundation_from": [f.get("from", 0.0) for f in foundations],
        "foundation_to": [f.get("to", end) for f in foundations],
        **{f"foundation_{key}": [pair[0] for pair in pairs] for key, pairs in ends.items()},
        **{f"foundation_{key}_to": [pair[1] for pair in pairs] for key, pairs in ends.items()},
    }
    made = {key: np.array(values, dtype=float) for key, values in made.items()}
    made["foundation_shear"] = np.array([f.get("shear", 0.0) for f in foundations], dtype=float)
    made["foundation_side"] = np.array([SIDES[f.get("side", "both")] for f in foundations], dtype=np.int32)
    laws = [f["law"] if isinstance(f.get("law"), dict) else {} for f in foundations]
    codes = [GROUND_LAWS[law["type"]] if law else (0, ()) for law in laws]
    made["foundation_law"] = np.array([code for code, _ in codes], dtype=np.int32)
    parameters = np.zeros((len(foundations), 3, 2))
    for row, law, (_, keys) in zip(parameters, laws, codes, strict=True):
        for i, key in enumerate(keys):
            row[i] = number(law.get(key, 0.0))
    made["foundation_parameter"], made["foundation_parameter_to"] = (parameters[:, :, end].copy() for end in (0, 1))
    for name, key, pair in (("profile", "profile", ("x", "gap")), ("ground_law", "law", ("displacement", "force"))):
        lists = [f[key] if isinstance(f.get(key), list) else [] for f in foundations]
        points = [(k, *point) for k, of in enumerate(lists) for point in of]
        made[f"{name}_foundation"] = np.array([k for k, *_ in points], dtype=np.int32)
        for i, column in enumerate(pair, 1):
            made[f"{name}_{column}"] = np.array([point[i] for point in points], dtype=float)
    points = []
    for k, (f, law, (_, keys)) in enumerate(zip(foundations, laws, codes, strict=True)):
        given = {1: f.get("k", 0.0), **{3 + i: law.get(key, 0.0) for i, key in enumerate(keys)}}
        points += [(k, quantity, *point) for quantity, value in given.items() if number(value) is not value for point in value]
    for i, (name, kind) in enumerate((("foundation", np.int32), ("quantity", np.int32), ("x", float), ("value", float))):
        made[f"table_{name}"] = np.array([point[i] for point in points], dtype=kind)
    return made


def number(value):
    """A number or a pair of a foundation; 0 of a table."""
    return 0.0 if isinstance(value, list) and isinstance(value[0], list) else value


def pointer(array):
    """Where an array is, as ctypes passes it."""
    return array.ctypes.data_as(INTEGER if array.dtype == np.int32 else REAL)


class Library:
    """The shared library, loaded."""

    def __init__(self, path):
        self.c = c.CDLL(str(path))
        self.c.gapbeam_status_message.restype = c.c_char_p
        self.c.gapbeam_version_text.restype = c.c_char_p
        self.c.gapbeam_infinity.restype = c.c_double
        for name in ("free_beam", "free_state", "free_history", "count_supports", "count_nodes"):
            getattr(self.c, f"gapbeam_{name}").argtypes = [c.c_void_p]

    def model(self, arrays):
        """A gapbeam_model; the arrays must live as long as it."""
        made = Model()
        assert self.c.gapbeam_model_init(c.byref(made), c.c_size_t(c.sizeof(made))) == 0
        for name, array in arrays.items():
            setattr(made, name, array if isinstance(array, int) else pointer(array))
        sizes = {"spans": "length", "masses": "mass_x", "hinges": "hinge_x", "supports": "support_x", "loads": "load_value",
                 "law_points": "law_force",
                 "foundations": "foundation_k", "profile_points": "profile_x", "ground_law_points": "ground_law_force",
                 "table_points": "table_x", "sections": "section_from"}  # fmt: skip
        for name, key in sizes.items():
            setattr(made, name, len(arrays[key]))
        return made

    def prepare(self, scene):
        """A prepared beam, or the status and the message."""
        arrays = columns(scene)
        model, message, handle = self.model(arrays), c.create_string_buffer(400), c.c_void_p()
        status = self.c.gapbeam_prepare(c.byref(model), c.byref(handle), message, c.c_size_t(400))
        return (CBeam(self, handle, len(arrays["support_x"])), "") if status == 0 else (status, message.value.decode())


class CBeam:
    """A prepared beam and one state of it, through the C interface."""

    def __init__(self, library, handle, supports):
        self.c, self.handle, self.supports = library.c, handle, supports
        self.state, self.history = c.c_void_p(), c.c_void_p()
        assert self.c.gapbeam_new_state(c.byref(self.state)) == 0

    def close(self):
        """Free everything."""
        self.c.gapbeam_free_history(self.history)
        self.c.gapbeam_free_state(self.state)
        self.c.gapbeam_free_beam(self.handle)

    def replace_loads(self, library, scene):
        """Status of taking the loads of another scene."""
        arrays = columns(scene)
        return self.c.gapbeam_replace_loads(self.handle, c.byref(library.model(arrays)), None, c.c_size_t(0))

    def solve(self, factor, rule="block"):
        """Status and message of a solve."""
        options, message = Options(c.sizeof(Options), RULES[rule], 0), c.create_string_buffer(400)
        status = self.c.gapbeam_solve(
            self.handle, c.c_double(factor), c.byref(options), self.state, message, c.c_size_t(400)
        )
        return status, message.value.decode()

    def follow(self, factor, rule="block"):
        """Status, message and events: (factor, support, condition)."""
        options, message, number = Options(c.sizeof(Options), RULES[rule], 0), c.create_string_buffer(400), c.c_int(-1)
        room = 1000
        at, which, what = np.empty(room), np.empty(room, np.int32), np.empty(room, np.int32)
        status = self.c.gapbeam_follow(
            self.handle, c.c_double(factor), c.byref(options), room, pointer(at), pointer(which), pointer(what),
            c.byref(number), self.state, message, c.c_size_t(400),
        )  # fmt: skip
        assert number.value <= room
        return status, message.value.decode(), list(zip(at, which, what, strict=True))[: max(number.value, 0)]

    def follow_history(self, factors, at_limit):
        """Status, message and the history."""
        factors, message = np.array(factors, dtype=float), c.create_string_buffer(400)
        self.c.gapbeam_free_history(self.history)
        status = self.c.gapbeam_follow_history(
            self.handle, len(factors), pointer(factors), AT_LIMIT[at_limit], c.byref(self.history), message, c.c_size_t(400)
        )
        if status != 0:
            return status, message.value.decode(), None
        info = HistoryInfo(c.sizeof(HistoryInfo))
        assert self.c.gapbeam_get_history_info(self.history, c.byref(info)) == 0
        n, m, k = info.stretches, info.events, info.limits
        ends, about = np.empty((2, n)), np.empty((6, n), np.int32)
        assert self.c.gapbeam_get_stretches(self.history, *map(pointer, (*ends, *about))) == 0
        at, of_events = np.empty(m), np.empty((4, m), np.int32)
        assert self.c.gapbeam_get_events(self.history, pointer(at), *map(pointer, of_events)) == 0
        where, of_limits = np.empty(k), np.empty((4, k), np.int32)
        assert self.c.gapbeam_get_limits(self.history, pointer(where), *map(pointer, of_limits)) == 0
        exact, known = np.empty(n, np.int32), np.empty(k, np.int32)
        assert self.c.gapbeam_get_exact(self.history, pointer(exact), pointer(known)) == 0
        events = [(f, s, CHANGES[e]) for f, s, e in zip(at, of_events[0], of_events[2], strict=True)]
        limits = [(f, KINDS_OF_LIMIT[a], leg, to, bool(on)) for f, a, leg, _, to, on in zip(where, *of_limits, known, strict=True)]
        return 0, "", History(ends.T, about.T, events, limits, exact.astype(bool).tolist(), ENDINGS[info.ending])

    def solve_on_path(self, stretch, factor):
        """Status and message of a solve on the history followed last."""
        message = c.create_string_buffer(400)
        status = self.c.gapbeam_solve_on_path(
            self.handle, self.history, stretch, c.c_double(factor), self.state, message, c.c_size_t(400)
        )
        return status, message.value.decode()

    def released(self, limit):
        """Status of gapbeam_get_released_energy for the history followed last, and the energy."""
        energy = c.c_double(0.0)
        status = self.c.gapbeam_get_released_energy(self.handle, self.history, limit, c.byref(energy), None, c.c_size_t(0))
        return status, energy.value

    def history_motion(self):
        """Places of the nodes and their displacements where the history ends in a motion, or None."""
        n = self.c.gapbeam_count_nodes(self.handle)
        x, motion = np.empty(n), np.empty(n)
        status = self.c.gapbeam_get_history_motion(self.history, pointer(x), pointer(motion))
        return None if status else (x, motion)

    def info(self):
        """The structure gapbeam_info."""
        info = Info(c.sizeof(Info))
        assert self.c.gapbeam_get_info(self.state, c.byref(info)) == 0
        return info

    def at_supports(self):
        """Reaction, deflection, opening, couple, condition."""
        values = [np.empty(self.supports) for _ in range(4)] + [np.empty(self.supports, np.int32)]
        assert self.c.gapbeam_get_supports(self.handle, self.state, *map(pointer, values)) == 0
        return values

    def friction(self):
        """Force, slip and way of sliding of friction at every support."""
        count = self.c.gapbeam_count_supports(self.handle)
        values = [np.empty(count), np.empty(count), np.empty(count, np.int32)]
        assert self.c.gapbeam_get_friction(self.handle, self.state, *map(pointer, values)) == 0
        return values

    def fields(self, x, left=False, expect=0):
        """Fields at places, 6 by places; the status must be as expected."""
        x = np.array(x, dtype=float)
        found = np.full((len(x), 6), np.nan)
        status = self.c.gapbeam_get_fields(
            self.handle, self.state, len(x), pointer(x), int(left), pointer(found), None, c.c_size_t(0)
        )
        assert status == expect
        return found.T

    def extremes(self, expect=0):
        """Values and places, 6 by 2 each; the status must be as expected."""
        value, x = np.empty((6, 2)), np.empty((6, 2))
        assert self.c.gapbeam_get_extremes(self.handle, self.state, pointer(value), pointer(x)) == expect
        return value, x

    def quantities(self, which, x, left=False, expect=0):
        """Quantities by their numbers, from 0, at places; the status must be as expected."""
        which, x = np.array(which, np.int32), np.array(x, dtype=float)
        found = np.full((len(x), len(which)), np.nan)
        status = self.c.gapbeam_get_quantities(
            self.handle, self.state, len(which), pointer(which), len(x), pointer(x), int(left), pointer(found), None,
            c.c_size_t(0),
        )  # fmt: skip
        assert status == expect
        return found.T

    def quantity_extremes(self, which, expect=0):
        """Their values and places, by 2 each."""
        which = np.array(which, np.int32)
        value, x = np.empty((2, len(which), 2))
        status = self.c.gapbeam_get_quantity_extremes(
            self.handle, self.state, len(which), pointer(which), pointer(value), pointer(x), None, c.c_size_t(0)
        )
        assert status == expect
        return value, x

    def motion(self):
        """Places of the nodes and their displacements."""
        n = self.c.gapbeam_count_nodes(self.handle)
        x, motion = np.empty(n), np.empty(n)
        assert self.c.gapbeam_get_motion(self.handle, self.state, pointer(x), pointer(motion)) == 0
        return x, motion

    def modes(self, kind, count):
        """Status and the first values of modes."""
        values, number = np.empty(count), c.c_int(-1)
        status = self.c.gapbeam_get_modes(
            self.handle, self.state, kind, count, pointer(values), c.byref(number), None, c.c_size_t(0)
        )
        return status, values[: max(number.value, 0)].tolist()

    def mode_shape(self, kind, value, parts):
        """Places, deflections, moments left and right of them, amplitude and support."""
        number, given = c.c_int(-1), (self.handle, self.state, kind, c.c_double(value), parts)
        assert self.c.gapbeam_get_mode_shape(*given, 0, None, None, None, c.byref(number), None, c.c_size_t(0)) == 0
        n, swing, support = number.value, c.c_double(), c.c_int()
        found = np.empty(n), np.empty(n), np.empty((n, 2))
        assert self.c.gapbeam_get_mode_shape(*given, n, *map(pointer, found), None, None, c.c_size_t(0)) == 0
        assert self.c.gapbeam_get_mode_amplitude(*given, c.byref(swing), c.byref(support), None, c.c_size_t(0)) == 0
        return found[0], found[1], found[2].T, swing.value, support.value

    def buckling(self):
        """Share of the axial forces that it bears, places and deflections."""
        share, number = c.c_double(), c.c_int(-1)
        assert self.c.gapbeam_get_buckling(self.handle, self.state, c.byref(share), 0, None, None, c.byref(number)) == 0
        found = np.empty((2, number.value))
        assert self.c.gapbeam_get_buckling(self.handle, self.state, None, number.value, *map(pointer, found), None) == 0
        return share.value, *found

    def unique(self):
        """Is the state known to be the only one."""
        return bool(self.info().unique)

    def follow_ground(self, factor, rule="block"):
        """Status and events of a beam on foundations: factor, support, foundation, place, change, branch."""
        options, number, most = Options(c.sizeof(Options), RULES[rule], 0), c.c_int(0), 1000
        values, codes = np.empty((2, most)), np.empty((4, most), np.int32)
        status = self.c.gapbeam_follow_ground(
            self.handle, c.c_double(factor), c.byref(options), most, pointer(values[0]), *map(pointer, codes[:3]),
            pointer(values[1]), pointer(codes[3]), c.byref(number), self.state, None, c.c_size_t(0),
        )  # fmt: skip
        columns = (values[0], codes[0], codes[1], values[1], codes[3], codes[2])
        return status, list(zip(*(column[: number.value].tolist() for column in columns), strict=True))

    def contact(self):
        """Foundation, ends, condition and resultant of every zone of contact."""
        number = c.c_int(-1)
        assert self.c.gapbeam_get_contact(self.handle, self.state, 0, None, None, None, None, None, c.byref(number)) == 0
        n = number.value
        values, codes = np.empty((3, n)), np.empty((2, n), np.int32)
        at = [codes[0], values[0], values[1], codes[1], values[2]]
        assert self.c.gapbeam_get_contact(self.handle, self.state, n, *map(pointer, at), None) == 0
        return list(zip(*(column.tolist() for column in at), strict=True))

    def free_spans(self):
        """Foundation, ends and sag of every free span."""
        number = c.c_int(-1)
        assert self.c.gapbeam_get_free_spans(self.handle, self.state, 0, None, None, None, None, c.byref(number)) == 0
        n = number.value
        at = [np.empty(n, np.int32), *np.empty((3, n))]
        assert self.c.gapbeam_get_free_spans(self.handle, self.state, n, *map(pointer, at), None) == 0
        return list(zip(*(column.tolist() for column in at), strict=True))

    def pressure(self, x, left=False):
        """Pressure of the ground at places."""
        x = np.array(x, dtype=float)
        found = np.full(len(x), np.nan)
        status = self.c.gapbeam_get_pressure(
            self.handle, self.state, len(x), pointer(x), int(left), pointer(found), None, c.c_size_t(0)
        )
        assert status == 0
        return found

    def pressure_extremes(self):
        """Maximum and minimum, and their places."""
        value, x = np.empty(2), np.empty(2)
        assert self.c.gapbeam_get_pressure_extremes(self.handle, self.state, pointer(value), pointer(x)) == 0
        return value, x

    def certificate(self):
        """The structure gapbeam_certificate, and which supports are undecided."""
        found, undecided = Certificate(c.sizeof(Certificate)), np.empty(self.supports, np.int32)
        assert self.c.gapbeam_get_certificate(self.handle, self.state, c.byref(found), pointer(undecided)) == 0
        return found, undecided


class F77Beam:
    """The same through the Fortran 77 interface: arrays and integers by reference, handles as whole numbers."""

    def __init__(self, library, scene):
        self.c, a = library.c, columns(scene)
        self.supports, self.hinges, self.loads = len(a["support_x"]), len(a["hinge_x"]), len(a["load_x"])
        self.on_ground = len(a["length"]) + 2 * len(a["foundation_k"]) + len(a["profile_x"]) + len(a["table_x"])
        self.beam, self.state, self.history = (np.zeros(1, np.int64) for _ in range(3))
        self.both = (self.beam, self.state)
        span = np.array([a["length"], a["EI"], a["GA"], a["EA"]]).T.copy()
        sup = np.array([a[f"support_{n}"] for n in ("x", "stiffness", "gap", "settlement", "rotation")]).T.copy()
        isup = np.array([a[f"support_{n}"] for n in ("side", "direction", "node")], np.int32).T.copy()
        model = [len(span), span, self.hinges, a["hinge_x"], len(sup), isup, sup, *self.loads_of(a)]
        alaw, ilaw = np.array([a["law_displacement"], a["law_force"]]).T.copy(), a["law_support"] + np.int32(1)
        sides, foundations = a["foundation_side"], ("from", "to", "k", "k_to", "gap", "gap_to")
        rubs = a["support_friction"].any()
        named = a["support_law"].any() or rubs
        along = [KINDS[name] for name in ("axial", "temperature", "axial_uniform")]
        pressed = not (a["first_order"] or named) and np.isin(a["load_kind"], along).any()
        feels = pressed or a["stretching"] or a["with_trains"] or a["N"].any() or a["mass"].any() or len(a["mass_x"])
        cut = len(a["section_from"])
        feels = feels or a["foundation_shear"].any() or cut
        plain = "ghprfr" if rubs else "ghprsl" if named else "ghprlw" if len(ilaw) else "ghprep"
        prepare = "ghpraf" if feels else "ghprfd" if len(sides) else plain
        if len(ilaw) or len(sides) or named or feels:
            model += [len(ilaw), ilaw, alaw, a["support_unloading"]]
        if named:
            model += [a["support_law"], a["support_parameter"], *([a["support_friction"]] if rubs else [])]
        if len(sides) or feels:
            model += [len(sides), sides, np.array([a[f"foundation_{n}"] for n in foundations]).T.copy()]
            for name, pair in (("profile", ("x", "gap")), ("ground_law", ("displacement", "force"))):
                points = np.array([a[f"{name}_{column}"] for column in pair]).T.copy()
                model += [len(points), a[f"{name}_foundation"] + np.int32(1), points]
            model += [a["foundation_law"], np.hstack([a[f"foundation_parameter{end}"] for end in ("", "_to")])]
            tables = np.array([a["table_foundation"] + 1, a["table_quantity"]], np.int32).T.copy()
            model += [len(tables), tables, np.array([a["table_x"], a["table_value"]]).T.copy()]
        if feels:
            forces = a["N_grows"] + 2 * a["first_order"] + 4 * a["stretching"] + 8 * a["with_trains"]
            model += [np.array([a["N"], a["mass"]]).T.copy(), a["foundation_shear"], forces]
        if len(a["mass_x"]):
            prepare = "ghprlm"
        if len(a["mass_x"]) or cut:
            model += [len(a["mass_x"]), np.array([a["mass_x"], a["lumped_mass"]]).T.copy()]
        if cut:
            prepare = "ghprsc"
            powers = np.array([a[f"section_{key}_power"] for key in ("EI", "GA", "EA")], np.int32).T.copy()
            numbers = ("from", "to", "EI", "EI_to", "GA", "GA_to", "EA", "EA_to", "N", "friction",
                       "friction_to", "bedding")  # fmt: skip
            model += [cut, powers, np.array([a[f"section_{key}"] for key in numbers]).T.copy()]
        self.entry = np.zeros(1, np.int32)
        self.info_ = self.call(prepare, *model, self.beam, self.entry)
        assert self.call("ghstat", self.state) == 0

    def __del__(self):
        for handle in (self.beam, self.state, self.history):
            self.call("ghfree", handle)

    @staticmethod
    def loads_of(a):
        """NLOAD, ILOAD, ALOAD."""
        aload = np.array([a[f"load_{n}"] for n in ("x", "to", "value", "value_to")]).T.copy()
        iload = np.array([a[f"load_{n}"] for n in ("kind", "case", "node")], np.int32).T.copy()
        iload[:, 2] += np.isin(iload[:, 0], (KINDS["movement"], 8, 12))
        return len(aload), iload, aload

    def call(self, name, *arguments):
        """INFO of a routine."""
        info = c.c_int(-999)
        passed = [
            pointer(a) if isinstance(a, np.ndarray) else c.byref(c.c_double(a) if isinstance(a, float) else c.c_int(a))
            for a in arguments
        ]
        getattr(self.c, name + "_")(*passed, c.byref(info))
        return info.value

    def solve(self, factor, rule="block", start=0):
        """INFO of GHSOLV."""
        return self.call("ghsolv", self.beam, float(factor), RULES[rule], start, self.state)

    def replace_loads(self, scene):
        """INFO of taking the loads of another scene."""
        return self.call("ghload", self.beam, *self.loads_of(columns(scene)))

    def contact(self):
        """As CBeam.contact."""
        n = np.zeros(1, np.int32)
        assert self.call("ghcont", *self.both, 0, n, n, n) == 0
        zone, codes = np.empty((n[0], 3)), np.empty((n[0], 2), np.int32)
        assert self.call("ghcont", *self.both, int(n[0]), n, zone, codes) == 0
        return [(k - 1, a, b, state, r) for (a, b, r), (k, state) in zip(zone.tolist(), codes.tolist(), strict=True)]

    def free_spans(self):
        """As CBeam.free_spans."""
        n = np.zeros(1, np.int32)
        assert self.call("ghfrsp", *self.both, 0, n, n, n) == 0
        free, which = np.empty((n[0], 3)), np.empty(n[0], np.int32)
        assert self.call("ghfrsp", *self.both, int(n[0]), n, free, which) == 0
        return [(k - 1, *values) for k, values in zip(which.tolist(), free.tolist(), strict=True)]

    def pressure(self, x, left=False):
        """As CBeam.pressure."""
        found = np.full(len(x), np.nan)
        assert self.call("ghpres", *self.both, len(x), np.array(x, dtype=float), int(left), found) == 0
        return found

    def pressure_extremes(self):
        """As CBeam.pressure_extremes."""
        value, x = np.empty(2), np.empty(2)
        assert self.call("ghpxtr", *self.both, value, x) == 0
        return value, x

    def follow(self, factor, rule="block"):
        """INFO and events of GHEVNT."""
        number, at, which = np.zeros(1, np.int32), np.empty(1000), np.empty((1000, 2), np.int32)
        info = self.call("ghevnt", self.beam, float(factor), RULES[rule], 1000, self.state, number, at, which)
        n = number[0]
        return info, [(f, k - 1, s) for f, (k, s) in zip(at[:n], which[:n], strict=True)]

    def follow_ground(self, factor, rule="block"):
        """As CBeam.follow_ground."""
        number, at, which = np.zeros(1, np.int32), np.empty((1000, 2)), np.empty((1000, 4), np.int32)
        info = self.call("ghgevt", self.beam, float(factor), RULES[rule], 1000, self.state, number, at, which)
        n = number[0]
        found = zip(at[:n].tolist(), which[:n].tolist(), strict=True)
        return info, [(f, k - 1, g - 1, x, change, branch) for (f, x), (k, g, branch, change) in found]

    def follow_history(self, factors, at_limit):
        """INFO and the history."""
        self.call("ghfree", self.history)
        sizes = np.zeros(6, np.int32)
        factors = np.array(factors, dtype=float)
        info = self.call("ghhist", self.beam, len(factors), factors, AT_LIMIT[at_limit], self.history, sizes)
        if info != 0:
            return info, None
        n, m, k, ending, *_ = sizes.tolist()
        ends, about = np.empty((n, 2)), np.empty((n, 6), np.int32)
        at, of_events, where, of_limits = np.empty(m), np.empty((m, 4), np.int32), np.empty(k), np.empty((k, 4), np.int32)
        assert self.call("ghhget", self.history, n, ends, about, m, at, of_events, k, where, of_limits) == 0
        about[:, 0] -= 1
        events = [(f, s - 1, CHANGES[e]) for f, (s, _, e, _) in zip(at, of_events, strict=True)]
        exact, known = np.empty(n, np.int32), np.empty(k, np.int32)
        assert self.call("ghhexa", self.history, n, exact, k, known) == 0
        limits = [
            (f, KINDS_OF_LIMIT[a], leg - 1, to - 1, bool(on))
            for f, (a, leg, _, to), on in zip(where, of_limits, known, strict=True)
        ]
        return 0, History(ends, about, events, limits, exact.astype(bool).tolist(), ENDINGS[ending])

    def solve_on_path(self, stretch, factor):
        """INFO of GHHSOL for the history followed last."""
        return self.call("ghhsol", self.beam, self.history, stretch + 1, float(factor), self.state)

    def released(self, limit):
        """INFO and energy of GHHENG for the history followed last."""
        energy = np.zeros(1)
        return self.call("ghheng", self.beam, self.history, limit + 1, energy), float(energy[0])

    def modes(self, kind, count):
        """As CBeam.modes."""
        values, number = np.empty(count), np.zeros(1, np.int32)
        info = self.call("ghmode", *self.both, kind, count, values, number)
        return info, values[: number[0]].tolist()

    def mode_shape(self, kind, value, parts):
        """As CBeam.mode_shape."""
        n, given = np.zeros(1, np.int32), (*self.both, kind, float(value), parts)
        swing, support = np.zeros(1), np.zeros(1, np.int32)
        assert self.call("ghshap", *given, 0, n, n, n, n) == 0
        assert self.call("ghampl", *given, swing, support) == 0
        found = np.empty(n[0]), np.empty(n[0]), np.empty((n[0], 2))
        assert self.call("ghshap", *given, int(n[0]), n, *found) == 0
        return found[0], found[1], found[2].T, float(swing[0]), int(support[0]) - 1

    def buckling(self):
        """As CBeam.buckling."""
        share, n = np.zeros(1), np.zeros(1, np.int32)
        assert self.call("ghbuck", *self.both, share, 0, n, n, n) == 0
        found = np.empty((2, n[0]))
        assert self.call("ghbuck", *self.both, share, int(n[0]), n, *found) == 0
        return float(share[0]), *found

    def unique(self):
        """As CBeam.unique."""
        found = np.zeros(1, np.int32)
        assert self.call("ghuniq", self.state, found) == 0
        return bool(found[0])

    def at_supports(self):
        """As CBeam.at_supports."""
        values, state = np.empty((self.supports, 4)), np.empty(self.supports, np.int32)
        assert self.call("ghsupp", *self.both, values, state) == 0
        return [*values.T, state]

    def friction(self):
        """As CBeam.friction."""
        values, slides = np.empty((self.supports, 2)), np.empty(self.supports, np.int32)
        assert self.call("ghfric", *self.both, values, slides) == 0
        return [*values.T, slides]

    def fields(self, x, left=False, expect=0):
        """As CBeam.fields."""
        found = np.full((len(x), 6), np.nan)
        assert self.call("ghflds", *self.both, len(x), np.array(x, dtype=float), int(left), found) == expect
        return found.T

    def extremes(self, expect=0):
        """As CBeam.extremes."""
        value, x = np.empty((6, 2)), np.empty((6, 2))
        assert self.call("ghxtrm", *self.both, value, x) == expect
        return value, x

    def quantities(self, which, x, left=False, expect=0):
        """As CBeam.quantities."""
        found = np.full((len(x), len(which)), np.nan)
        numbers = np.array(which, np.int32) + np.int32(1)
        status = self.call("ghquan", *self.both, len(which), numbers, len(x), np.array(x, dtype=float), int(left), found)
        assert status == expect
        return found.T

    def quantity_extremes(self, which, expect=0):
        """As CBeam.quantity_extremes."""
        value, x = np.empty((2, len(which), 2))
        assert self.call("ghqxtr", *self.both, len(which), np.array(which, np.int32) + np.int32(1), value, x) == expect
        return value, x

    def motion(self):
        """As CBeam.motion."""
        room = self.hinges + self.supports + 2 * self.loads + 2 + self.on_ground
        n, x, motion = np.zeros(1, np.int32), np.empty(room), np.empty(room)
        assert self.call("ghmotn", *self.both, room, n, x, motion) == 0
        return x[: n[0]], motion[: n[0]]

    def certificate(self):
        """Numbers of the certificate, and which supports are undecided."""
        numbers, known, undecided = np.empty(9), np.zeros(1, np.int32), np.empty(self.supports, np.int32)
        assert self.call("ghcert", *self.both, numbers, known, undecided) == 0
        return numbers, known[0], undecided
