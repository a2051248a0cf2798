"""Copies of variables in WebAssembly locals: a load of what a local still holds is saved.

The memory is always current: every store goes there at once, and a local only keeps what was
loaded or stored last. So a fault, a call, a tag, another program find each variable as the program
left it, and forgetting a copy is always right. What is gained is the time from a store to the load
of the same variable, which is what small programs and loops wait for.

Few copies live at a time: the code generator of wasmtime takes quadratic time in live locals, and
what does not fit into registers goes to memory again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable

    from plcsim.program.structured_text import ir
    from plcsim.program.structured_text.codegen.places import ScalarPlace

MOST_COPIES: Final = 24
"""Copies alive at a time, beside those that a loop holds on to."""

MOST_LOCALS: Final = 20_000
"""Locals of one function for copies; WebAssembly allows 50,000 in all."""

Known = dict["ScalarPlace", int]
"""What locals hold at one point of the code, oldest first: the local of each key."""


class Copies:
    """The copies of one function, at the point where code is being written.

    Args:
        new_local: returns a new local for values of a width.
        this: the function is the body of a block.

    Attributes:
        known: what locals hold here; None where no path of the program leads to.
    """

    __slots__ = ("_held", "_local_of", "_new_local", "_seen", "_this", "known")

    def __init__(self, new_local: Callable[[ir.Width], int], *, this: bool) -> None:
        self.known: Known | None = {}
        self._new_local = new_local
        self._local_of: dict[ScalarPlace, int] = {}
        self._this = this
        self._seen: dict[int, ScalarPlace | None] = {}
        self._held: set[ScalarPlace] = set()

    def local_of(self, key: ScalarPlace) -> int | None:
        """Return the local that holds the variable here."""
        return self.known.get(key) if self.known else None

    def note(self, key: ScalarPlace) -> int | None:
        """Return the local that is now to be set to the value of the variable.

        None where there is to be no copy: locals are used up, or nothing leads here.
        """
        if self.known is None:
            return None
        local = self._local_of.get(key)
        if local is None:
            if len(self._local_of) >= MOST_LOCALS:
                return None
            local = self._local_of[key] = self._new_local(key.width)
            first = self._seen.setdefault(key.root, key)
            if first != key:
                self._seen[key.root] = None  # more than one place in this root
        if key not in self.known:
            self._make_room(self.known)
            self.known[key] = local
        return local

    def _make_room(self, known: Known) -> None:
        if len(known) - len(self._held) < MOST_COPIES:
            return
        oldest = next(key for key in known if key not in self._held)
        del known[oldest]

    def forget_met(self, key: ScalarPlace) -> None:
        """Forget what a store to another place than `known` ones may have changed."""
        if self.known and (self._this or self._seen.get(key.root, key) != key):
            for other in [k for k in self.known if k != key and k.meets(key)]:
                del self.known[other]

    def forget_roots(self, roots: Collection[int]) -> None:
        """Forget all copies that a change of variables with these roots may make wrong."""
        if self.known:
            for key in [k for k in self.known if k.is_in(roots, this=self._this)]:
                del self.known[key]

    def fork(self) -> Known | None:
        """Return what is known here, to go on from it at another place of the code."""
        return None if self.known is None else self.known.copy()

    def hold(self, keys: Iterable[ScalarPlace]) -> set[ScalarPlace]:
        """Keep these copies alive from here on; return what `release` takes."""
        before = self._held
        self._held = before.union(keys)
        return before

    def is_held(self, key: ScalarPlace) -> bool:
        """Tell whether a loop around this point keeps the copy."""
        return key in self._held

    def release(self, before: set[ScalarPlace]) -> None:
        """End what `hold` began."""
        self._held = before


def join(one: Known | None, other: Known | None) -> Known | None:
    """Return what is known where two paths meet."""
    if one is None:
        return other
    if other is None or one is other:
        return one
    return {key: local for key, local in one.items() if key in other}
