"""Labels in a picture that keep clear of one another; lengths in points."""

#: Height of a line of text
LINE = 9.0


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
