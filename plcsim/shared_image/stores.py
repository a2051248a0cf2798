"""Writes in the scan: checked as a whole first, then stored; what was there before is the answer.

The record is read where it lies in the ring, without copies: a service that changes it meanwhile
changes its own data, never an address that was checked.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.errors import PageFault
from plcsim.core.memory import FIRST
from plcsim.shared_image.command import HEAD, MASK, MASKS, OPERATION, SCATTER, STORE, Mask

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.core.memory import Memory
    from plcsim.core.owners import Owners


Store = tuple[int, int, int]
"""Bytes from the record at the first number to the variables from the second to the third."""


class _Scatter(NamedTuple):
    """Single bytes from the record at ``at`` to places among the variables."""

    at: int
    offsets: Sequence[int]


class _Mask(NamedTuple):
    """A word among the variables that is changed by masks."""

    at: int
    start: int
    mask: Mask


class Plan(NamedTuple):
    """A write that was checked.

    Attributes:
        owners: of what it stores, as bits.
        steps: one after another.
        work: stores, masks and scattered bytes.
    """

    owners: int
    steps: list[Store | _Scatter | _Mask]
    work: int


class Stores:
    """Writes of all services.

    Args:
        memory: where the variables lie; no more are allocated later.
        owners: of the variables.
        followers: told address and bytes of every store.
    """

    def __init__(
        self,
        memory: Memory,
        owners: Owners,
        followers: Sequence[Callable[[int, bytes], None]] = (),
    ) -> None:
        self._variables = memory.view(FIRST, memory.used)
        self._owners = owners
        self._followers = followers

    def plan(self, record: memoryview[int], count: int) -> Plan:
        """Return how a record is stored.

        Args:
            record: of a `Write`.
            count: of its operations.

        Raises:
            ValueError: the record makes no sense.
            PageFault: something of it lies outside the variables.
        """
        steps: list[Store | _Scatter | _Mask] = []
        owners, work, at = 0, count, HEAD.size
        size, limit = len(record), FIRST + len(self._variables)
        owners_of = self._owners.of_range
        for _ in range(count):
            if at + OPERATION.size > size:
                raise ValueError("record ends inside an operation")
            address, length, kind = OPERATION.unpack_from(record, at)
            at += OPERATION.size
            if at + length > size:
                raise ValueError("record ends inside its data")
            if kind == STORE:
                low, high = address, address + length
                steps.append((at, low - FIRST, high - FIRST))
            else:
                step, low, high = _other(record, at, address, kind, length)
                steps.append(step)
                work += length // 5
            if not FIRST <= low < high <= limit:
                raise PageFault(low, high - low)
            owners |= owners_of(low, high - low)
            at += length
        return Plan(owners, steps, work)

    def apply(self, record: memoryview[int], plan: Plan) -> None:
        """Store, and note in the record what was there before."""
        variables = self._variables
        for step in plan.steps:
            if isinstance(step, _Scatter):
                _scatter(variables, record, step)
            elif isinstance(step, _Mask):
                at, start, mask = step
                word = int.from_bytes(variables[start : start + 2], "little")
                record[at : at + 2] = variables[start : start + 2]
                variables[start : start + 2] = mask.applied_to(word).to_bytes(2, "little")
            else:
                at, start, end = step
                behind = at + end - start
                data = bytes(record[at:behind])
                record[at:behind] = variables[start:end]
                variables[start:end] = data
        if self._followers:
            self._tell(plan)

    def _tell(self, plan: Plan) -> None:
        """Tell what has been stored where."""
        for start, end in (range_ for step in plan.steps for range_ in _ranges(step)):
            data = bytes(self._variables[start:end])
            for told in self._followers:
                told(FIRST + start, data)


def _ranges(step: Store | _Scatter | _Mask) -> list[tuple[int, int]]:
    """Return where a step has stored something, as places among the variables."""
    if isinstance(step, _Scatter):
        return [(offset, offset + 1) for offset in step.offsets]
    return [(step.start, step.start + 2)] if isinstance(step, _Mask) else [step[1:]]


def _scatter(variables: memoryview[int], record: memoryview[int], step: _Scatter) -> None:
    at, offsets = step
    behind = at + len(offsets)
    data = bytes(record[at:behind])
    record[at:behind] = bytes([variables[offset] for offset in offsets])
    for offset, value in zip(offsets, data, strict=True):
        variables[offset] = value


def _other(
    record: memoryview[int], at: int, address: int, kind: int, length: int
) -> tuple[_Scatter | _Mask, int, int]:
    """Return a step of another kind than a store, and the range of addresses it concerns."""
    if kind == MASK and length == MASKS.size:
        return (
            _Mask(at, address - FIRST, Mask(address, *MASKS.unpack_from(record, at))),
            address,
            address + 2,
        )
    if kind == SCATTER and length and length % 5 == 0:
        count = length // 5
        addresses = struct.unpack_from(f"<{count}I", record, at)
        scatter = _Scatter(at + 4 * count, [each - FIRST for each in addresses])
        return scatter, min(addresses), max(addresses) + 1
    raise ValueError(f"operation of kind {kind} with {length} bytes")
