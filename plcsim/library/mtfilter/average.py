"""MTFilterMovingAverage."""

from __future__ import annotations

import struct
from typing import Any, Final

from plcsim.library.heap import heap_of
from plcsim.library.mtbasics.block import OK, UpdatedBlock
from plcsim.library.mtfilter import interface
from plcsim.library.mtfilter.interface import mtBCD_ERR_FILTER_WINDOW_INVALID

_REAL: Final = struct.Struct("<f")
LARGEST_WINDOW: Final = 9999


class MTFilterMovingAverage(interface.MTFilterMovingAverage, UpdatedBlock):
    """Out is the mean of the latest WindowLength values, of fewer while there are no more.

    WindowLength, 1 to 9999, is taken over when the block is enabled and by Update, which begins
    anew. The values lie on the heap.
    """

    Internal: Any

    @property
    def common(self) -> Any:
        """What the block keeps."""
        return self.Internal

    def wrong(self) -> int:
        """Look at the length."""
        fits = 1 <= self.WindowLength <= LARGEST_WINDOW
        return OK if fits else mtBCD_ERR_FILTER_WINDOW_INVALID

    def take(self) -> None:
        """Reserve memory for the values."""
        own = self.Internal
        heap_of(self.context).release(own.pValues)
        own.WindowLength, own.Count, own.Next = self.WindowLength, 0, 0
        own.pValues = heap_of(self.context).allocate(4 * self.WindowLength) or 0

    def run(self, _step_s: float) -> None:
        """Take a value."""
        own, memory = self.Internal, self.context.memory
        if not own.pValues:  # memory is full
            self.Out = self.In
            return
        memory.write(own.pValues + 4 * own.Next, _REAL.pack(self.In))
        own.Next = (own.Next + 1) % own.WindowLength
        own.Count = min(own.Count + 1, own.WindowLength)
        values = memory.view(own.pValues, 4 * own.Count).cast("f")
        self.Out = sum(values) / own.Count

    def end(self) -> None:
        """Give the memory back."""
        heap_of(self.context).release(self.Internal.pValues)
        self.Internal.pValues = 0
