"""Variables as what has changed since the last record: runs of bytes, each with its place."""

from __future__ import annotations

import struct
from typing import Final

import numpy as np

from plcsim.recorder.errors import RecordingError

_RUN: Final = struct.Struct("<II")
_GAP: Final = 8
"""So many bytes that are the same between two changes are written too: a run costs as much."""


def changes(before: bytes, after: bytes) -> bytes:
    """Return what makes ``after`` of ``before``, which is as long."""
    if before == after:
        return b""
    old, new = np.frombuffer(before, np.uint8), np.frombuffer(after, np.uint8)
    places = np.flatnonzero(old != new)
    breaks = np.flatnonzero(np.diff(places) > _GAP)
    firsts = places[np.concatenate(([0], breaks + 1))].tolist()
    lasts = places[np.concatenate((breaks, [len(places) - 1]))].tolist()
    runs = []
    for first, last in zip(firsts, lasts, strict=True):
        runs += [_RUN.pack(first, last + 1 - first), after[first : last + 1]]
    return b"".join(runs)


def changed(before: bytes, runs: bytes) -> bytes:
    """Return what `changes` was given as ``after``.

    Raises:
        RecordingError: these are no changes of such variables.
    """
    if not runs:
        return before
    after, at = bytearray(before), 0
    while at < len(runs):
        if at + _RUN.size > len(runs):
            raise RecordingError("the changes of a cycle are not complete")
        place, size = _RUN.unpack_from(runs, at)
        at += _RUN.size
        if at + size > len(runs) or place + size > len(after):
            raise RecordingError("the changes of a cycle are not complete")
        after[place : place + size] = runs[at : at + size]
        at += size
    return bytes(after)
