"""What one step of a node may do at most."""

from __future__ import annotations

from typing import NamedTuple


class StepLimits(NamedTuple):
    """Bounds of one step; what does not fit waits for the next, in turn.

    Attributes:
        bytes_in: bytes read from topic and service connections.
        bytes_out: bytes written.
        bytes_parsed: bytes read from XML-RPC connections, which cost most to parse.
        messages: messages, requests, replies and calls taken from what was read.
        accepts: new connections taken.
        calls: connections started: to publishers, services and other nodes.
        polls: connections looked at.
    """

    bytes_in: int = 131_072
    bytes_out: int = 131_072
    bytes_parsed: int = 8_192
    messages: int = 200
    accepts: int = 4
    calls: int = 4
    polls: int = 32


UNPACED = StepLimits(
    bytes_in=4 << 20, bytes_out=4 << 20, bytes_parsed=1 << 20, messages=10_000, accepts=100,
    calls=100, polls=1_000,
)  # fmt: skip
"""Limits of a node that owns its process, such as a benchmark, where a long step hurts nobody."""


class Budget:
    """What is left of the limits within a step.

    Args:
        limits: of the step.
    """

    __slots__ = ("accepts", "bytes_in", "bytes_out", "bytes_parsed", "calls", "messages", "polls")

    def __init__(self, limits: StepLimits) -> None:
        self.bytes_in = limits.bytes_in
        self.bytes_out = limits.bytes_out
        self.bytes_parsed = limits.bytes_parsed
        self.messages = limits.messages
        self.accepts = limits.accepts
        self.calls = limits.calls
        self.polls = limits.polls
