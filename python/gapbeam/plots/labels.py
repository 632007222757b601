"""Labels in a picture that keep clear of one another, and how wide texts are; lengths in points."""

from functools import lru_cache
from warnings import catch_warnings, filterwarnings

from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

#: Height of a line of text; what is left of the beam on the page; size of the letters of a label, and what is free beside it
LINE, MARGIN, LETTERS, FREE = 9.0, 92.0, 6.8, 3.0


@lru_cache(maxsize=10_000)
def measured_width(text: str, size: float, weight: str = "normal") -> float:
    """Measure a text, its longest line.

    Parameters
    ----------
    text : str
        The text, lines parted by newlines.
    size, weight : float, str
        Of its letters.
    """
    font = FontProperties(weight=weight, size=size)
    with catch_warnings():
        filterwarnings("ignore", "Glyph .* missing")  # said where the text is drawn
        return max(text_to_path.get_text_width_height_descent(line, font, ismath=False)[0] for line in text.split("\n"))


def text_width(text: str) -> float:
    """Give the width of a label with what is free beside it.

    Examples
    --------
    >>> text_width("2 kN")
    18.512500000000003
    """
    return measured_width(text, LETTERS) + FREE


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
