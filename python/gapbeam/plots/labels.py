"""Labels in a picture that keep clear of one another; lengths in points."""

#: Height of a line of text; what is left of the beam on the page
LINE, MARGIN = 9.0, 92.0


def text_width(text: str) -> float:
    """Estimate the width of a label, of its longest line.

    Examples
    --------
    >>> text_width("2 kN")
    19.0
    """
    return 4.0 * max(map(len, text.split("\n"))) + 3.0


class Labels:
    """The rectangles that labels take."""

    def __init__(self) -> None:
        self._taken: list[tuple[float, float, float, float]] = []

    def take(self, x: float, y: float, text: str) -> bool:
        """Take the place of a label, if it is free.

        Parameters
        ----------
        x, y : float
            Middle and foot.
        text : str
            The label, lines parted by newlines.

        Returns
        -------
        bool
            Whether it was free.
        """
        half, top = text_width(text) / 2, y + LINE * (1 + text.count("\n"))
        if any(abs(x - at) <= half + width and y < high and top > low for at, width, low, high in self._taken):
            return False
        self._taken.append((x, half, y, top))
        return True


def spread(wanted: list[float], apart: float, top: float) -> list[float]:
    """Move ascending heights as little as need be for a distance between them, the highest not above `top`.

    Parameters
    ----------
    wanted : list of float
        Heights.
    apart, top : float
        Distance, and the upper end.

    Examples
    --------
    >>> spread([0.0, 1.0, 50.0], 10.0, 100.0)
    [0.0, 10.0, 50.0]
    >>> spread([98.0, 99.0], 10.0, 100.0)
    [90.0, 100.0]
    """
    places: list[float] = []
    for height in wanted:
        places.append(max(height, places[-1] + apart) if places else height)
    for k in range(len(places) - 1, -1, -1):
        places[k] = min(places[k], top - apart * (len(places) - 1 - k))
    return places
