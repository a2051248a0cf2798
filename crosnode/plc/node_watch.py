"""Tells people what the nodes of programs miss, whether or not the programs tell it.

It looks at the nodes from outside, so a program's ``pop_status`` still gives all news.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.transport.tcpip_socket import SocketPool
from plcsim.core.logbook import Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from crosnode.node import CrosNode
    from plcsim.core.context import Context

PATIENCE_NS: Final = 3_000_000_000
"""A master that starts together with the controller, or again, is not worth a line."""


SHORTAGE_NS: Final = 600_000_000_000

DROPS_GROW: Final = 10
"""Times as many messages of a topic are dropped when it is told again."""


class News(NamedTuple):
    """A line of the logbook."""

    severity: Severity
    text: str


@dataclass(slots=True)
class _Watched:
    """A node, and how long it has been without its master.

    Attributes:
        node: of a program.
        steps_ns: what its steps had taken when it was looked at, to see whether it does any.
        missed_ns: since when no master was found, None where one is.
        is_told: whether that was told.
        kills: times that others ended it, as far as they were told.
        is_behind: whether it was told that its steps do not suffice.
        drops: of each topic, how many dropped messages are told of next.
    """

    node: CrosNode
    steps_ns: int = 0
    missed_ns: int | None = None
    is_told: bool = False
    kills: int = 0
    is_behind: bool = False
    drops: dict[str, int] = field(default_factory=dict)


class NodeWatch:
    """The nodes of the programs of one controller; ``context.library(NodeWatch)``."""

    def __init__(self, context: Context) -> None:
        self._pool = context.library(SocketPool)
        self._shortages = self._pool.shortages
        self._next_shortage_ns = 0
        self._watched: list[_Watched] = []

    def add(self, node: CrosNode) -> None:
        """Look after a node until it ends."""
        self._watched.append(_Watched(node))

    def look(self, now_ns: int) -> Iterator[News]:
        """Iterate over what is new; call it about once a second."""
        yield from self._shortage(now_ns)
        for each in self._watched:
            yield from _kills(each)
            yield from _pace(each)
            yield from _drops(each)
        self._watched = [each for each in self._watched if not each.node.is_shut_down]
        for each in self._watched:
            name, master = each.node.name, each.node.core.master
            if _misses(each, now_ns) and not each.is_told:
                each.is_told = True
                yield News(Severity.WARNING, f"{name}: no master at {master.uri}; trying on")
            elif each.is_told and master.is_found:
                each.is_told = False
                yield News(Severity.INFORMATION, f"{name}: master at {master.uri} found")

    def _shortage(self, now_ns: int) -> Iterator[News]:
        """Tell that connections wait for an ident, once in ten minutes."""
        shortages, self._shortages = self._shortages, self._pool.shortages
        if shortages != self._shortages and now_ns >= self._next_shortage_ns:
            self._next_shortage_ns = now_ns + SHORTAGE_NS
            text = f"no AsTCP ident is free: all {self._pool.idents} of [library.AsTCP] are in use"
            yield News(Severity.WARNING, text)


def _kills(each: _Watched) -> Iterator[News]:
    """Tell that others ended the node, which a program may not look for."""
    life = each.node.life
    if life.kills != each.kills:
        each.kills = life.kills
        after = "for good; respawn = true in [ros] brings it back"
        text = f"{each.node.name}: ended {after if life.is_over else 'and will return'}"
        yield News(Severity.WARNING, f"{text}: {life.reason}")


def _pace(each: _Watched) -> Iterator[News]:
    """Tell that peers send more than the node's steps take, and when they no longer do."""
    pace = each.node.pace
    if pace.is_behind and not each.is_behind:
        text = "peers send more than its steps take; [ros.step] bounds a step"
        yield News(Severity.WARNING, f"{each.node.name}: {text}")
    elif each.is_behind and not pace.is_behind:
        yield News(Severity.INFORMATION, f"{each.node.name}: keeps up again")
    each.is_behind = pace.is_behind


def _drops(each: _Watched) -> Iterator[News]:
    """Tell of messages that came faster than the program took them.

    A queue of one message is there for the newest one, and dropping the others is its purpose.
    """
    subscribers = each.node.subscribers
    each.drops = {topic: least for topic, least in each.drops.items() if topic in subscribers}
    for topic, subscriber in subscribers.items():
        dropped, length = subscriber.dropped, subscriber.queue.length
        if length > 1 and dropped >= each.drops.get(topic, 1):
            each.drops[topic] = DROPS_GROW * dropped
            text = f"{dropped} messages dropped, its queue_size is {length}"
            yield News(Severity.WARNING, f"{each.node.name}: {topic}: {text}")


def _misses(each: _Watched, now_ns: int) -> bool:
    """Note how it is; return whether a node that does its steps has had no master for too long."""
    steps_ns, each.steps_ns = each.steps_ns, each.node.statistics.total_ns
    if each.node.core.master.is_found or steps_ns == each.steps_ns:
        each.missed_ns = None
    elif each.missed_ns is None:
        each.missed_ns = now_ns
    return each.missed_ns is not None and now_ns - each.missed_ns >= PATIENCE_NS
