"""What code accesses: which variables it loads and stores, and which it may change otherwise.

Source: the rules on roots in `plcsim.program.structured_text.ir`.
"""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.places import ScalarPlace, key_of

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

_WRITING_HELPERS: Final = frozenset({"rt.string_assign", "rt.wstring_assign"})
"""Those of `ir.RUNTIME` that write through their first argument; the others write nothing."""


def _parts(*names: str) -> Callable[[Any], tuple[Any, ...]]:
    if len(names) == 1:
        one = attrgetter(names[0])
        return lambda node: (one(node),)
    return attrgetter(*names)


def _of_place(node: ir.Load | ir.AddressOf) -> tuple[Any, ...]:
    base = node.place.base
    return () if type(base) is ir.Segment else (base,)


def _of_store(node: ir.Store) -> tuple[Any, ...]:
    base = node.place.base
    return (node.value,) if type(base) is ir.Segment else (base, node.value)


def _of_if(node: ir.If) -> list[Any]:
    inside = [part for arm in node.arms for part in (arm.condition, *arm.body)]
    return [*inside, *node.other]


def _of_switch(node: ir.Switch) -> list[Any]:
    inside = [part for case in node.cases for part in case.body]
    return [node.selector, *inside, *node.other]


_NOTHING: Final[tuple[Any, ...]] = ()

PARTS: Final[Mapping[type, Callable[[Any], Sequence[Any]]]] = {
    ir.Const: lambda _: _NOTHING,
    ir.Local: lambda _: _NOTHING,
    ir.Load: _of_place,
    ir.AddressOf: _of_place,
    ir.Unary: _parts("operand"),
    ir.Convert: _parts("operand"),
    ir.Binary: _parts("left", "right"),
    ir.Compare: _parts("left", "right"),
    ir.Select: _parts("then", "other", "condition"),
    ir.IfExpression: _parts("condition", "then", "other"),
    ir.Call: attrgetter("arguments"),
    ir.Checked: _parts("index"),
    ir.StatementExpression: lambda node: (*node.statements, node.value),
    ir.Store: _of_store,
    ir.SetLocal: _parts("value"),
    ir.Evaluate: _parts("value"),
    ir.If: _of_if,
    ir.Switch: _of_switch,
    ir.Block: attrgetter("body"),
    ir.Loop: attrgetter("body"),
    ir.Break: lambda _: _NOTHING,
    ir.Continue: lambda _: _NOTHING,
    ir.Return: lambda node: () if node.value is None else (node.value,),
    ir.CopyBytes: _parts("target", "source", "count"),
    ir.FillBytes: _parts("target", "value", "count"),
}
"""The expressions and statements directly inside each kind of node."""


def nodes_of(parts: Sequence[Any]) -> Iterator[Any]:
    """Yield nodes and all that is inside them."""
    left_over = list(parts)
    while left_over:
        node = left_over.pop()
        yield node
        left_over += PARTS[type(node)](node)


def roots_of(address: ir.Expression) -> set[int]:
    """Return the roots of what may be accessed through an address."""
    if isinstance(address, ir.AddressOf):
        return {address.place.root}
    return {0}.union(n.place.root for n in nodes_of([address]) if type(n) is ir.AddressOf)


def roots_given(call: ir.Call) -> set[int]:
    """Return the roots of what a call may access through its arguments."""
    found = set[int]()
    for argument in call.arguments:
        if argument.type == "i32" and type(argument) is not ir.Const:
            found |= roots_of(argument)
    return found


class Effects:
    """What the functions of a module may change when they are called."""

    def __init__(self, module: ir.Module) -> None:
        self._functions = {function.name: function for function in module.functions}
        self._imports = module.imports
        self._direct: dict[str, tuple[set[int], set[str]]] = {}
        self._changed: dict[str, frozenset[int]] = {}

    def of_call(self, call: ir.Call) -> frozenset[int]:
        """Return the roots whose variables a call may change."""
        if call.function in ir.RUNTIME:
            writes = call.function in _WRITING_HELPERS
            return frozenset(roots_of(call.arguments[0]) if writes else ())
        return self.of_function(call.function) | roots_given(call)

    def of_function(self, name: str) -> frozenset[int]:
        """Return the roots of all variables that a function, and what it calls, may change."""
        found = self._changed.get(name)
        if found is None:
            self._resolve(name)
            found = self._changed[name]
        return found

    def calls_of(self, name: str) -> set[str]:
        """Return the functions and imports that a function calls itself."""
        return self._direct_of(name)[1]

    def _resolve(self, name: str) -> None:
        """Find the effects of a function and of all that it reaches, recursion among it."""
        roots: dict[str, set[int]] = {}
        callees: dict[str, set[str]] = {}
        left_over = [name]
        while left_over:
            one = left_over.pop()
            if one in self._changed:
                roots[one], callees[one] = set(self._changed[one]), set()
            elif one not in roots:
                changed, callees[one] = self._direct_of(one)
                roots[one] = set(changed)
                left_over += callees[one]
        _spread(roots, callees)
        self._changed.update({one: frozenset(changed) for one, changed in roots.items()})

    def _direct_of(self, name: str) -> tuple[set[int], set[str]]:
        """Return what a function changes itself, and what it calls."""
        if name in self._imports:
            return {0}, set()
        found = self._direct.get(name)
        if found is None:
            found = self._direct[name] = self._look_into(name)
        return found

    def _look_into(self, name: str) -> tuple[set[int], set[str]]:
        roots, called = set[int](), set[str]()
        for node in nodes_of(self._functions[name].body):
            kind = type(node)
            if kind is ir.Store:
                roots.add(node.place.root)
            elif kind is ir.CopyBytes or kind is ir.FillBytes:
                roots |= roots_of(node.target)
            elif kind is ir.Call:
                self._direct_call(node, roots, called)
        return roots, called

    def _direct_call(self, call: ir.Call, roots: set[int], called: set[str]) -> None:
        if call.function in ir.RUNTIME:
            roots |= self.of_call(call)
            return
        roots |= roots_given(call)
        called.add(call.function)


def _spread(roots: dict[str, set[int]], callees: Mapping[str, set[str]]) -> None:
    """Add to the roots of each function those of its callees, until nothing changes."""
    callers: dict[str, set[str]] = {name: set() for name in roots}
    for name, called in callees.items():
        for callee in called:
            callers[callee].add(name)
    left_over = list(roots)
    while left_over:
        callee = left_over.pop()
        for caller in callers[callee]:
            if not roots[callee] <= roots[caller]:
                roots[caller] |= roots[callee]
                left_over.append(caller)


class Accesses:
    """What the body of a loop accesses.

    Attributes:
        loaded: fixed scalars that it loads, with a place of each and the number of its loads.
        stored: fixed scalars that it stores, by root.
        changed: roots of variables that it may change in other ways.
        this: it is in the body of a block.
    """

    __slots__ = ("changed", "loaded", "stored", "this")

    def __init__(self, *, this: bool) -> None:
        self.this = this
        self.loaded: dict[ScalarPlace, tuple[ir.Place, int]] = {}
        self.stored: dict[int, set[ScalarPlace]] = {}
        self.changed: set[int] = set()

    def changes(self, key: ScalarPlace) -> bool:
        """Tell whether a copy of the variable may become wrong in a way that is not seen."""
        if key.is_in(self.changed, this=self.this):
            return True
        return any(
            len(self.stored[root]) > MOST_COMPARED
            or any(key != other and key.meets(other) for other in self.stored[root])
            for root in self._meeting(key.root)
        )

    def _meeting(self, root: int) -> Collection[int]:
        """Return the roots that are stored to and may have bytes in common with a root."""
        if not self.this:
            return (root,) if root in self.stored else ()
        return self.stored if root == 0 else self.stored.keys() & {0, root}

    def add_load(self, key: ScalarPlace, place: ir.Place, weight: int) -> None:
        """Count a load."""
        _, count = self.loaded.get(key, (place, 0))
        self.loaded[key] = place, count + weight

    def add_store(self, place: ir.Place, key: ScalarPlace | None) -> None:
        """Note a store; ``key`` is None where its address is known only when it runs."""
        if key:
            self.stored.setdefault(key.root, set()).add(key)
        else:
            self.changed.add(place.root)

    def add_inner(self, inner: Accesses, weight: int) -> None:
        """Add what a loop inside this one accesses; its loads count ``weight`` times."""
        for key, (place, count) in inner.loaded.items():
            self.add_load(key, place, count * weight)
        for root, keys in inner.stored.items():
            self.stored.setdefault(root, set()).update(keys)
        self.changed |= inner.changed


MOST_COMPARED: Final = 64
"""Stores to different places of one variable that are told from each other; time is linear."""

INNER_WEIGHT: Final = 8
"""Passes that a loop is taken to make, to choose what is worth a local."""


def loop_accesses(loop: ir.Loop, effects: Effects, *, this: bool) -> dict[int, Accesses]:
    """Return the accesses of a loop and of all loops inside it, by the identity of each."""
    found: dict[int, Accesses] = {}
    _collect(loop, effects, found, this=this)
    return found


def _collect(
    loop: ir.Loop, effects: Effects, found: dict[int, Accesses], *, this: bool
) -> Accesses:
    own = found[id(loop)] = Accesses(this=this)
    left_over: list[Any] = list(loop.body)
    while left_over:
        node = left_over.pop()
        kind = type(node)
        if kind is ir.Loop:
            own.add_inner(_collect(node, effects, found, this=this), INNER_WEIGHT)
            continue
        if kind is ir.Load:
            key = key_of(node.place, node.width, this=this)
            if key:
                own.add_load(key, node.place, 1)
        elif kind is ir.Store:
            own.add_store(node.place, key_of(node.place, node.width, this=this))
        elif kind is ir.Call:
            own.changed |= effects.of_call(node)
        elif kind is ir.CopyBytes or kind is ir.FillBytes:
            own.changed |= roots_of(node.target)
        left_over += PARTS[kind](node)
    return own
