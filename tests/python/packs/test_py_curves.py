"""p-y curves: ultimate resistances by hand, curves at the points of their sources, and how far polylines are off."""

from math import cos, radians, sin, tan

import gapbeam
import numpy as np
import pytest
from gapbeam import packs
from gapbeam.packs.py_curves import CLAY_ERROR, sand_coefficients, sand_modulus

CLAY = {"D": 0.6, "cu": 26.0, "gamma": 8.0, "eps50": 0.01}
STIFF = {"D": 0.6, "cu": 100.0, "gamma": 18.0, "eps50": 0.005}


def resistance(law, y):
    """Of a polyline from (0, 0)."""
    points = np.array([(0.0, 0.0), *law])
    return np.interp(y, points[:, 0], points[:, 1])


@pytest.mark.parametrize(
    ("z", "ultimate"),
    [
        (0.0, 3.0 * 26.0 * 0.6),  # 46.8
        (3.0, (3.0 + 8.0 * 3.0 / 26.0 + 0.5 * 3.0 / 0.6) * 26.0 * 0.6),  # 100.2
        (9.0, 9.0 * 26.0 * 0.6),  # 140.4, the deeper mechanism
    ],
)
def test_ultimate_resistance_of_soft_clay(z, ultimate):
    assert packs.matlock_clay(z, **CLAY)[-1][1] == pytest.approx(ultimate, rel=1e-14)


@pytest.mark.parametrize(("share", "of_ultimate"), [(0.1, 0.23), (0.3, 0.33), (1.0, 0.50), (3.0, 0.72), (8.0, 1.00), (100.0, 1.00)])
def test_soft_clay_at_the_points_of_api(share, of_ultimate):
    """API RP 2A and 2GEO, short-term static: p/pu over y/yc, two digits."""
    law, off = packs.matlock_clay(3.0, **CLAY), 0.005 + CLAY_ERROR["matlock_clay"]
    assert resistance(law, share * 2.5 * 0.01 * 0.6) == pytest.approx(of_ultimate * 100.2, abs=off * 100.2)


@pytest.mark.parametrize(
    ("z", "ultimate"),
    [
        (0.0, 3.0 * 100.0 * 0.6),  # 180
        (3.0, (3.0 + 18.0 * 3.0 / 100.0 + 0.5 * 3.0 / 0.6) * 100.0 * 0.6),  # 362.4
        (9.0, 9.0 * 100.0 * 0.6),  # 540
    ],
)
def test_ultimate_resistance_of_stiff_clay(z, ultimate):
    assert packs.reese_clay(z, **STIFF)[-1][1] == pytest.approx(ultimate, rel=1e-14)
    assert packs.reese_clay(3.0, average_cu=80.0, **STIFF)[-1][1] == pytest.approx((3.0 + 0.675 + 2.5) * 80.0 * 0.6, rel=1e-14)


@pytest.mark.parametrize(("share", "of_ultimate"), [(1.0 / 16.0, 0.25), (1.0, 0.5), (16.0, 1.0), (40.0, 1.0)])
def test_stiff_clay_at_its_points(share, of_ultimate):
    """Welch and Reese (1972): half of pu at y50, all of it from 16 y50 on."""
    law = packs.reese_clay(3.0, **STIFF)
    assert resistance(law, share * 2.5 * 0.005 * 0.6) == pytest.approx(of_ultimate * 362.4, abs=CLAY_ERROR["reese_clay"] * 362.4)


@pytest.mark.parametrize(("name", "given", "root", "end"), [("matlock_clay", CLAY, 3, 8.0), ("reese_clay", STIFF, 4, 16.0)])
def test_polylines_are_never_stiffer_and_off_as_stated(name, given, root, end):
    law = getattr(packs, name)(3.0, **given)
    y_end = end * 2.5 * given["eps50"] * given["D"]
    y = y_end * np.linspace(0.0, 1.0, 20001) ** 6
    below = law[-1][1] * (y / y_end) ** (1.0 / root) - resistance(law, y)
    assert below.min() > -1e-12 * law[-1][1]
    assert 0.9 * CLAY_ERROR[name] < below.max() / law[-1][1] <= CLAY_ERROR[name]
    slopes = np.diff([0.0, *(p for _, p in law)]) / np.diff([0.0, *(y for y, _ in law)])
    assert (np.diff(slopes) < 0.0).all()
    assert slopes[-1] == 0.0


@pytest.mark.parametrize("phi", [25.0, 30.0, 40.0])
def test_coefficients_of_sand_beside_their_other_form(phi):
    """Reese, Cox and Koop (1974) as openpile has them after Mosher and Dawkins (2008), with tan(beta - phi)."""
    beta, alpha, friction = radians(45.0 + phi / 2.0), radians(phi / 2.0), radians(phi)
    wedge, K0, Ka = tan(beta - friction), 0.4, tan(radians(45.0 - phi / 2.0)) ** 2
    C1 = (
        K0 * tan(friction) * sin(beta) / (wedge * cos(alpha))
        + tan(beta) ** 2 * tan(alpha) / wedge
        + K0 * tan(beta) * (tan(friction) * sin(beta) - tan(alpha))
    )
    C2 = tan(beta) / wedge - Ka
    C3 = K0 * tan(friction) * tan(beta) ** 4 + Ka * (tan(beta) ** 8 - 1.0)
    assert sand_coefficients(phi) == pytest.approx((C1, C2, C3), rel=1e-13)


@pytest.mark.parametrize(
    ("z", "cyclic", "ultimate"),
    [  # phi = 30: C1 = 1.9117, C2 = 2.6667, C3 = 28.745; D = 0.61, gamma = 9
        (3.0, True, 0.9 * (1.9117 * 3.0 + 2.6667 * 0.61) * 27.0),  # 178.9
        (12.0, True, 0.9 * 28.745 * 0.61 * 108.0),  # 1704.3, the deeper mechanism
        (6.0, False, 0.9 * (1.9117 * 6.0 + 2.6667 * 0.61) * 54.0),  # 636.5
        (1.0, False, (3.0 - 0.8 / 0.61) * (1.9117 + 2.6667 * 0.61) * 9.0),  # 53.8
    ],
)
def test_resistance_of_sand(z, cyclic, ultimate):
    law = packs.api_sand(z, D=0.61, phi=30.0, gamma=9.0, k=12000.0, cyclic=cyclic)
    assert law["type"] == "tanh"
    assert law["limit"] == pytest.approx(ultimate, rel=1e-4)
    assert law["stiffness"] == 12000.0 * z


@pytest.mark.parametrize(("phi", "k"), [(25.0, 5400.0), (35.0, 21005.0), (40.0, 44020.0)])
def test_modulus_of_sand(phi, k):
    """The fit of openpile: 197.8 phi^2 - 10232 phi + 136820, 5400 at least."""
    assert sand_modulus(phi) == pytest.approx(k, rel=1e-12)
    assert packs.api_sand(2.0, D=0.6, phi=phi, gamma=10.0)["stiffness"] == pytest.approx(2.0 * k)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda: packs.matlock_clay(-1.0, **CLAY), "matlock_clay: z: expected 0 or more, got -1"),
        (lambda: packs.matlock_clay(1.0, **CLAY | {"eps50": 0.0}), "matlock_clay: eps50: expected a number above 0, got 0"),
        (lambda: packs.reese_clay(1.0, free_water=True, **STIFF), "reese_clay: free_water: with free water the resistance"),
        (lambda: packs.reese_clay(1.0, **STIFF | {"D": -0.6}), "reese_clay: D: expected a number above 0, got -0.6"),
        (lambda: packs.api_sand(0.0, D=0.6, phi=30.0, gamma=9.0), "api_sand: z: expected a number above 0, got 0"),
        (lambda: packs.api_sand(1.0, D=0.6, phi=0.6, gamma=9.0), "api_sand: phi: expected 20 to 45, got 0.6"),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, message):
    with pytest.raises(gapbeam.SceneError) as error:
        wrong()
    assert str(error.value).startswith(message)
