"""The curve of a panel, read from its path."""

import numpy as np

TIMES = np.linspace(0.0, 1.0, 13)[1:, None]


def curve(axes, which=0):
    """Places and values along the drawn curve: the corners of its lines, and points of its cubics."""
    patches = [patch for patch in axes.patches if patch.get_label() == "curve"]
    if not patches:
        return [line for line in axes.lines if line.get_label() == "curve"][which].get_data()
    vertices, codes = patches[which].get_path().vertices, patches[which].get_path().codes
    found, k = [vertices[:1]], 1
    while k < len(codes):
        if codes[k] == 4:
            a, (b, c, d) = found[-1][-1], vertices[k : k + 3]
            t = TIMES
            found.append((1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d)
            k += 3
        else:
            found.append(vertices[k : k + 1])
            k += 1
    return np.concatenate(found).T
