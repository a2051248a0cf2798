"""What a person may have meant by a name that is not there."""

from __future__ import annotations

import difflib
from itertools import islice
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

MOST_KNOWN: Final = 2_000
"""Names that are looked at; each takes some 20 us."""


def did_you_mean(name: str, known: Iterable[str], most: int = 1) -> str:
    """Return "; did you mean ...?" with the names that are near, the nearest first; "" for none.

    Letters count alike in either case: ``q`` is near ``Q``.

    Args:
        name: that is not there.
        known: names that are.
        most: names offered.
    """
    spelt = {each.lower(): each for each in islice(known, MOST_KNOWN)}
    near = [spelt[each] for each in difflib.get_close_matches(name.lower(), spelt, n=most)]
    return f"; did you mean {', '.join(near)}?" if near else ""
