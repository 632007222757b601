"""Stretches on elastic ground by mpmath: writes the numbers in test_foundation.f90 that doubles and quadruple precision must meet.

Independent on purpose: steps of the equations' Taylor series from end to end in many digits, no closed form.

    python tests/oracle/stretch.py
"""

from itertools import pairwise

from mpmath import ceil, mp, mpf, nstr, sqrt

#: 1/EI, 1/GA, modulus at the left and right end, length; all exact in binary
CASES = [
    ("no ground", "0.5", "0.25", "0", "0", "3"),
    ("hardly any ground, theta 1e-8", "1", "0", "2**-105", "2**-105", "1"),
    ("stiff beam on soft ground", "2**-20", "2**-18", "1", "1", "1.5"),
    ("theta 0.6", "0.5", "0", "1", "1", "1"),
    ("just short", "1", "0", "63.9375", "63.9375", "1"),
    ("just long", "1", "0", "64.0625", "64.0625", "1"),
    ("theta 6", "1", "0", "64", "64", "3"),
    ("theta 64", "0.25", "0", "16", "16", "64"),
    ("shear, short", "0.5", "0.25", "5", "5", "1.25"),
    ("shear, two waves", "0.5", "0.25", "20", "20", "4"),
    ("a double root", "1", "0.5", "16", "16", "3"),
    ("roots beside a double one", "1", "0.5625", "16", "16", "3"),
    ("roots apart, one of them slow", "0.0625", "4", "8", "8", "2"),
    ("roots apart, one of them fast", "1", "1", "1024", "1024", "1"),
    ("rigid in bending", "0", "2", "4", "4", "3"),
    ("rigid", "0", "0", "4", "4", "3"),
    ("softening", "1", "0", "-5", "-5", "1"),
    ("softening, with shear", "0.5", "0.25", "-2", "-2", "1.25"),
    ("from zero", "0.5", "0", "0", "6", "1"),
    ("falling, with shear", "0.5", "0.125", "3", "0.75", "1.25"),
    ("rising, rigid in bending", "0", "0.25", "1", "2.5", "1"),
]
LOAD = [mpf(x) for x in ("0.75", "-1.5", "2.25", "0.375")]  # q_a, q_b, q_c, kappa
ENDS = [mpf(x) for x in ("1", "-0.5", "0.25", "0.75")]  # w_a, w_b, M_a, M_b
PLACES = [mpf("0.25"), mpf("0.8125")]


def step(y, stretch, load, x, h):
    """w, psi, M, V a distance h on."""
    f, g, k_a, k_b, length = stretch
    q_a, q_b, q_c, kappa = load
    k = k_a + (k_b - k_a) * x / length, (k_b - k_a) / length
    q = (
        q_a + (q_b - q_a) * x / length + q_c * x * (length - x) / length**2,
        (q_b - q_a) / length + q_c * (length - 2 * x) / length**2,
        -q_c / length**2,
    )
    w, psi, m, v = ([value] for value in y)
    total, power, small, n = list(y), mpf(1), 0, 0
    while small < 8:
        more = (
            psi[n] + g * v[n],
            (kappa if n == 0 else 0) - f * m[n],
            v[n],
            k[0] * w[n] + (k[1] * w[n - 1] if n else 0) - (q[n] if n < 3 else 0),
        )
        n += 1
        power *= h
        for series, value in zip((w, psi, m, v), more, strict=True):
            series.append(value / n)
        change = [series[n] * power for series in (w, psi, m, v)]
        total = [a + b for a, b in zip(total, change, strict=True)]
        small = small + 1 if all(abs(a) <= mp.eps * abs(b) for a, b in zip(change, total, strict=True)) else 0
    return total


def numbers(stretch):
    """The link's ten coefficients, what the load makes at the ends, and the fields at the places."""
    f, g, k_a, k_b, length = stretch
    k = max(abs(k_a), abs(k_b))
    lengths = length * sqrt(k * g + 2 * sqrt(k * f))
    mp.dps = 80 + int(lengths)
    pieces = int(ceil(lengths / 2)) or 1
    stops = sorted({mpf(i) / pieces for i in range(pieces + 1)} | set(PLACES))
    columns = [[mpf(i == j) for i in range(4)] for j in range(4)] + [[mpf(0)] * 4]
    seen = {mpf(0): columns}
    for a, b in pairwise(stops):
        columns = [
            step(y, stretch, LOAD if j == 4 else [0] * 4, a * length, (b - a) * length)
            for j, y in enumerate(columns)
        ]
        seen[b] = columns

    def start(w_a, w_b, m_a, m_b, load):
        """w, psi, M, V at the left end: shooting."""
        t = columns
        w = w_b - t[0][0] * w_a - t[2][0] * m_a - t[4][0] * load
        m = m_b - t[0][2] * w_a - t[2][2] * m_a - t[4][2] * load
        determinant = t[1][0] * t[3][2] - t[3][0] * t[1][2]
        return (
            w_a,
            (t[3][2] * w - t[3][0] * m) / determinant,
            m_a,
            (t[1][0] * m - t[1][2] * w) / determinant,
            load,
        )

    def at(place, first):
        return [sum(first[j] * seen[place][j][i] for j in range(5)) for i in range(4)]

    units = [start(*(mpf(i == j) for i in range(5))) for j in range(5)]
    (_, turn_a, _, shear_a, _), (_, turn_b, _, shear_b) = units[4], at(mpf(1), units[4])
    right = [at(mpf(1), unit) for unit in units]
    link = [-units[0][1], right[1][1], units[1][1], units[3][3], units[2][1], units[3][1], -right[3][1]]
    link += [-units[0][3], -units[1][3], right[1][3]]
    fields = [value for place in PLACES for value in at(place, start(*ENDS, mpf(1)))]
    return link, [turn_a, -turn_b, shear_a, -shear_b], fields


def literal(text):
    """A number in quadruple precision as Fortran writes it."""
    if "**" in text:
        return f"2.0_qp**({text.split('**')[1]})"
    return text + ("_qp" if "." in text else ".0_qp")


def main():
    """Write the table."""
    for name, *texts in CASES:
        values = [mpf(2) ** int(text[3:]) if "**" in text else mpf(text) for text in texts]
        rows = [
            nstr(x if abs(x) > mpf(10) ** -60 else mpf(0), 36) + "_qp"
            for part in numbers(values)
            for x in part
        ]
        rows = [", ".join(rows[first : first + 2]) for first in range(0, len(rows), 2)]
        print(f'        call compare("{name}", [{", ".join(map(literal, texts))}], &')
        print("                     [" + ", &\n                      ".join(rows) + "])")


if __name__ == "__main__":
    main()
