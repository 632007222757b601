"""p-y curves of piles at a depth, as laws of a foundation: any consistent units, forces per length of the pile.

Clays are powers of the displacement, infinitely stiff at first, which no foundation may be. They are polylines whose points lie on
the curve, so that the soil is never stiffer than it says; how far it is below at most, is `CLAY_ERROR`.
"""

from __future__ import annotations

from math import cos, radians, sin, tan

from ..base.errors import SceneError
from .given import check_above_zero, check_between, check_not_negative

SEGMENTS = 16
"""Of a polyline up to the ultimate resistance."""
CLAY_ERROR = {"matlock_clay": 0.0042, "reese_clay": 0.006}
"""How far polylines are below their curves at most, as a share of the ultimate resistance."""


def matlock_clay(
    z: float, *, D: float, cu: float, gamma: float, eps50: float, J: float = 0.5, cyclic: bool = False
) -> list[tuple[float, float]]:
    """Give Matlock's curve of soft clay: p = 0.5 pu (y/y50)^(1/3) up to 8 y50, from there on pu; cyclic falling beyond 3 y50.

    pu is the lesser of (3 + gamma z/cu + J z/D) cu D and 9 cu D, y50 = 2.5 eps50 D.

    Matlock (1970), OTC 1204, as quoted by OpenBrIM, Soft Clay (Matlock): "p = 0.5 pult (y/y50)^(1/3)", "pult = [3 + gamma'/cu z +
    J/b z] cu b", "pult = 9 cu b", "y50 = 2.5 eps50 b", "the value of p remains constant beyond y = 8 y50". Under cyclic loading
    "zr = 6 c b/(gamma' b + J c)", "for depths greater than or equal to zr, then p is equal to 0.72 pu for y > 3 y50", "for depths
    less than zr, the value of p reduces from 0.72 pu at y = 3 y50" to "p = 0.72 pu z/zr" "at y = 15 y50" and "remains constant".

    Parameters
    ----------
    z : float
        Depth below the ground (length).
    D : float
        Diameter of the pile (length).
    cu : float
        Undrained shear strength (force/length^2).
    gamma : float
        Effective unit weight above the depth, on average (force/length^3).
    eps50 : float
        Strain at half of the strength (no unit).
    J : float
        0.5 for soft clay, 0.25 for medium clay (no unit).
    cyclic : bool
        Cyclic loading, as of a storm; default static.

    Returns
    -------
    list of (float, float)
        Law of a foundation: displacement, force per length. It is below the curve by 0.42 % of pu at most.

    Examples
    --------
    >>> law = matlock_clay(3.0, D=0.6, cu=26.0, gamma=8.0, eps50=0.01)
    >>> [(round(y, 6), round(p, 2)) for y, p in law[-3:]]
    [(0.081472, 88.07), (0.12, 100.2), (0.24, 100.2)]
    >>> law = matlock_clay(3.0, D=0.6, cu=26.0, gamma=8.0, eps50=0.01, cyclic=True)
    >>> [(round(y, 6), round(p, 2)) for y, p in law[-3:]]
    [(0.045, 72.14), (0.225, 41.16), (0.45, 41.16)]
    """
    _check_clay("matlock_clay", z, D=D, cu=cu, gamma=gamma, eps50=eps50, J=J)
    ultimate, y50 = _ultimate_clay(z, D, cu, cu, gamma, J), 2.5 * eps50 * D
    if not cyclic:
        return _clay_points(ultimate, 8.0 * y50, 3)
    peak = 0.72 * ultimate
    residual = peak * min(z * (gamma * D + J * cu) / (6.0 * cu * D), 1.0)
    return [*_clay_points(peak, 3.0 * y50, 3)[:-1], (15.0 * y50, residual), (30.0 * y50, residual)]


def reese_clay(
    z: float,
    *,
    D: float,
    cu: float,
    gamma: float,
    eps50: float,
    J: float = 0.5,
    average_cu: float | None = None,
    free_water: bool = False,
) -> list[tuple[float, float]]:
    """Give the static curve of stiff clay without free water: p = 0.5 pu (y/y50)^(1/4) up to 16 y50, from there on pu.

    pu is the lesser of (3 + gamma z/ca + J z/D) ca D and 9 cu D, y50 = 2.5 eps50 D.

    Welch and Reese (1972), as quoted by OpenBrIM, Stiff Clay without Free Water: "p = 0.5 pu (y/y50)^(1/4)", "pu = [3 + gamma/c z +
    J/b z] ca b", "pu = 9 cu b", "beyond point where displacement, y, equals to 16 y50, p is equal to pu".

    Parameters
    ----------
    z : float
        Depth below the ground (length).
    D : float
        Diameter of the pile (length).
    cu : float
        Undrained shear strength at the depth (force/length^2).
    gamma : float
        Effective unit weight above the depth, on average (force/length^3).
    eps50 : float
        Strain at half of the strength (no unit).
    J : float
        As of `matlock_clay` (no unit).
    average_cu : float, optional
        ca: strength from the ground down to the depth, on average (force/length^2); default cu.
    free_water : bool
        True is refused: this is another curve (Reese, Cox and Koop, 1975).

    Returns
    -------
    list of (float, float)
        Law of a foundation: displacement, force per length. It is below the curve by 0.6 % of pu at most.

    Raises
    ------
    SceneError
        Free water, or a number that makes no sense.

    Examples
    --------
    >>> reese_clay(3.0, D=0.6, cu=100.0, gamma=18.0, eps50=0.005)[-1]
    (0.24, 362.4)
    """
    if free_water:
        problem = "with free water the resistance falls beyond a peak (Reese, Cox and Koop, 1975), by a curve that is not here"
        raise SceneError("reese_clay: free_water", f"{problem}; give its points as law")
    ca = cu if average_cu is None else average_cu
    _check_clay("reese_clay", z, D=D, cu=cu, average_cu=ca, gamma=gamma, eps50=eps50, J=J)
    return _clay_points(_ultimate_clay(z, D, cu, ca, gamma, J), 16.0 * 2.5 * eps50 * D, 4)


def api_sand(
    z: float, *, D: float, phi: float, gamma: float, k: float | None = None, cyclic: bool = False
) -> dict[str, float | str]:
    """Give the curve of sand of API RP 2A: p = A pu tanh(k z y/(A pu)), with A = 3 - 0.8 z/D of 0.9 or more, cyclic 0.9.

    pu is the lesser of (C1 z + C2 D) gamma z and C3 D gamma z.

    API RP 2A (2010), as quoted by OpenBrIM, Sand (API): "p = A pu tanh(k z/(A pu) y)", "A = 3 - 0.8 z/b >= 0.9", "0.9 for cyclic
    loading", and C1, C2, C3 as in `sand_coefficients`.

    Parameters
    ----------
    z : float
        Depth below the ground (length), above 0.
    D : float
        Diameter of the pile (length).
    phi : float
        Angle of friction (degrees), 20 to 45.
    gamma : float
        Effective unit weight above the depth, on average (force/length^3).
    k : float, optional
        Initial modulus of subgrade reaction (force/length^3); default `sand_modulus`, for kN and m below the water table.
    cyclic : bool
        Cyclic loading; default static.

    Returns
    -------
    dict
        Law of a foundation, ``tanh``, exact.

    Examples
    --------
    >>> law = api_sand(2.0, D=0.6, phi=35.0, gamma=10.0)
    >>> law["type"], round(law["stiffness"]), round(law["limit"], 1)
    ('tanh', 42010, 143.9)
    """
    check_above_zero("api_sand", z=z, D=D, gamma=gamma)
    check_between("api_sand", "phi", phi, 20.0, 45.0)
    modulus = sand_modulus(phi) if k is None else k
    check_above_zero("api_sand", k=modulus)
    return {"type": "tanh", "stiffness": modulus * z, "limit": ultimate_sand(z, D, phi, gamma * z, cyclic)}


def _ultimate_clay(z: float, D: float, cu: float, average_cu: float, gamma: float, J: float) -> float:
    """Give the ultimate resistance of clay at a depth (force/length): the lesser of that near the ground and that far below."""
    return min(3.0 * average_cu * D + gamma * z * D + J * average_cu * z, 9.0 * cu * D)


def ultimate_sand(z: float, D: float, phi: float, stress: float, cyclic: bool) -> float:
    """Give A pu of sand at a depth (force/length).

    Parameters
    ----------
    z, D, phi : float
        As of `api_sand`.
    stress : float
        Effective vertical stress at the depth (force/length^2).
    cyclic : bool
        As of `api_sand`.
    """
    C1, C2, C3 = sand_coefficients(phi)
    A = 0.9 if cyclic else max(3.0 - 0.8 * z / D, 0.9)
    return A * min(C1 * z + C2 * D, C3 * D) * stress


def sand_coefficients(phi: float) -> tuple[float, float, float]:
    """Give C1, C2 and C3 of API's sand.

    Quoted by OpenBrIM, Sand (API): "C1 = tan beta {Kp tan alpha + K0 [tan phi sin beta (1/cos alpha + 1) - tan alpha]}", "C2 = Kp -
    Ka", "C3 = Kp^2 (Kp + K0 tan phi) - Ka", "K0 = 0.4, Ka = tan^2(pi/4 - phi/2)", "Kp = 1/Ka", alpha = phi/2, beta = pi/4 + phi/2.

    Parameters
    ----------
    phi : float
        Angle of friction (degrees).

    Examples
    --------
    >>> [round(C, 2) for C in sand_coefficients(30.0)]
    [1.91, 2.67, 28.75]
    """
    alpha, beta, friction = radians(phi / 2.0), radians(45.0 + phi / 2.0), tan(radians(phi))
    Kp, K0 = tan(beta) ** 2, 0.4
    C1 = tan(beta) * (Kp * tan(alpha) + K0 * (friction * sin(beta) * (1.0 / cos(alpha) + 1.0) - tan(alpha)))
    return C1, Kp - 1.0 / Kp, Kp**2 * (Kp + K0 * friction) - 1.0 / Kp


def sand_modulus(phi: float) -> float:
    """Give the initial modulus of subgrade reaction of sand below the water table (kN/m3).

    Quoted from openpile, Lateral soil models: "k = 197.8 phi^2 - 10232 phi + 136820 >= 5400", "a fit to the recommended values in
    DNVGL-RP-C212".

    Parameters
    ----------
    phi : float
        Angle of friction (degrees).

    Examples
    --------
    >>> round(sand_modulus(35.0))
    21005
    """
    return max(197.8 * phi**2 - 10232.0 * phi + 136820.0, 5400.0)


def _clay_points(ultimate: float, y_ultimate: float, root: int) -> list[tuple[float, float]]:
    """Give a polyline on ultimate*(y/y_ultimate)^(1/root), root 3 or 4, which ends level.

    With the square root of p in equal steps all segments but the first are about as far below the curve: the chord of a step t is
    off by (root - 1)/2 t^2 of the ultimate resistance.
    """
    steps = [k / SEGMENTS for k in range(1, SEGMENTS + 1)]
    return [(y_ultimate * t ** (2 * root), ultimate * t**2) for t in steps] + [(2.0 * y_ultimate, ultimate)]


def _check_clay(place: str, z: float, *, J: float, **numbers: float) -> None:
    check_not_negative(place, z=z, J=J, gamma=numbers.pop("gamma"))
    check_above_zero(place, **numbers)
