"""What happened to the parts of a thing that was carried."""

from typing import NamedTuple


class Tally(NamedTuple):
    """Counts of a carried thing, and a line that tells them.

    Args:
        text: what the command prints; "": nothing
        n_lost: parts without an image
        n_bad: elements that are inverted or flat
        certified: whether the thing and its image are certified, beyond the map itself
    """

    text: str = ""
    n_lost: int = 0
    n_bad: int = 0
    certified: bool = True
