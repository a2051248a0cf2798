"""Places: which accesses meet the same bytes, and what of an address is known beforehand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.program.structured_text import ir

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

THIS: Final = 0
"""Base of the members of the block whose body or action is running, in a `ScalarPlace`."""

NEAR: Final = 0x8000
"""Below a segment's start this many bytes are no variable: the nil pages lie before the first."""

HIGHEST: Final = 0x7FFF_FFFF


class ScalarPlace(NamedTuple):
    """A scalar at a fixed place: accesses with one key meet the same variable.

    Attributes:
        root: of the place.
        base: identity of the segment, or `THIS`.
        offset: bytes from the base.
        width: of the access.
    """

    root: int
    base: int
    offset: int
    width: ir.Width

    def meets(self, other: ScalarPlace) -> bool:
        """Tell whether the two may have bytes in common."""
        if self.base != other.base:  # two segments have no byte in common
            known_apart = THIS not in (self.base, other.base) or 0 not in (self.root, other.root)
            return not known_apart
        return (
            self.offset < other.offset + ir.BYTES[other.width]
            and other.offset < self.offset + ir.BYTES[self.width]
        )

    def is_in(self, roots: Collection[int], *, this: bool) -> bool:
        """Tell whether a change of variables with these roots may be one of this scalar.

        Args:
            roots: of what changes.
            this: it changes while the body of a block runs. The block's data may be reached
                through an address as well, if the instance is a global variable or has its address
                taken somewhere; so there, root 0 and the others may meet.
        """
        if self.root in roots:
            return True
        return this and bool(roots) and (self.root == 0 or 0 in roots)


def key_of(place: ir.Place, width: ir.Width, *, this: bool) -> ScalarPlace | None:
    """Return the key of an access, None where its address is known only when it runs.

    Args:
        place: what is accessed.
        width: of the access.
        this: local 0 is the address of the data block and never changes.
    """
    base = place.base
    if type(base) is ir.Segment:
        return ScalarPlace(place.root, id(base), place.offset, width)
    if this and type(base) is ir.Local and base.index == 0:
        return ScalarPlace(place.root, THIS, place.offset, width)
    return None


class Indexed(NamedTuple):
    """An address as ``segment + offset + sum of terms``, where no sum can wrap.

    Attributes:
        segment: what it lies in.
        offset: bytes from its start, maybe some below it.
        terms: unsigned numbers to add, each an index and a factor.
    """

    segment: ir.Segment
    offset: int
    terms: list[tuple[ir.Expression, int]]


def indexed(place: ir.Place) -> Indexed | None:
    """Return an element's address with all constants taken out of it.

    None where it has another form, or where an index is not known to be zero or more: its sum with
    the constants may wrap, which an offset of WebAssembly's does not.
    """
    if type(place.base) is not ir.Binary:
        return None
    segment, offset, limit = None, place.offset, 0
    terms: list[tuple[ir.Expression, int]] = []
    for addend in _addends(place.base):
        if type(addend) is ir.AddressOf and type(addend.place.base) is ir.Segment and not segment:
            segment = addend.place.base
            offset += addend.place.offset
            continue
        index, factor, constant = _scaled(addend)
        highest = highest_of(index)
        if highest is None:
            return None
        limit += highest * factor
        offset += constant
        terms.append((index, factor))
    if segment is None or limit > HIGHEST or not -NEAR <= offset <= HIGHEST:
        return None
    return Indexed(segment, offset, terms)


def _addends(expression: ir.Expression) -> list[ir.Expression]:
    """Return the operands of nested additions, in order."""
    found, left_over = [], [expression]
    while left_over:
        node = left_over.pop()
        if type(node) is ir.Binary and node.operator == "add" and not _is_scaled(node):
            left_over += (node.right, node.left)
        else:
            found.append(node)
    return found


def _is_scaled(node: ir.Binary) -> bool:
    """Tell whether an addition is an index with a constant, which `_scaled` takes apart."""
    return type(node.right) is ir.Const and highest_of(node.left) is not None


def _scaled(expression: ir.Expression) -> tuple[ir.Expression, int, int]:
    """Return an expression as index, factor and constant: ``index * factor + constant``."""
    node, factor, constant = expression, 1, 0
    if type(node) is ir.Binary and type(node.right) is ir.Const and node.operator in _FACTOR:
        value = int(node.right.value)
        factor = value if node.operator == "mul" else 1 << (value & 31)
        node = node.left
    if type(node) is ir.Binary and type(node.right) is ir.Const and node.operator in _SIGN:
        constant = _SIGN[node.operator] * int(node.right.value) * factor
        node = node.left
    if factor <= 0:
        return expression, 1, 0
    return node, factor, constant


_FACTOR: Final = ("mul", "shl")
_SIGN: Final[Mapping[str, int]] = {"add": 1, "sub": -1}
_HIGHEST_LOADED: Final[Mapping[ir.Width, int]] = {"u8": 0xFF, "u16": 0xFFFF}


def highest_of(expression: ir.Expression) -> int | None:
    """Return the highest value of an i32 that is zero or more; None where that is not known."""
    if type(expression) is ir.Load:
        return _HIGHEST_LOADED.get(expression.width)
    if type(expression) is ir.Checked:
        return expression.count - 1
    if type(expression) is ir.Const:
        value = int(expression.value)
        return value if 0 <= value <= HIGHEST else None
    if type(expression) is ir.Compare:
        return 1
    return None
