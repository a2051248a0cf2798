"""Derived types: strings, arrays, structures, data blocks, enumerations, references."""

from __future__ import annotations

from enum import Enum, IntEnum
from math import prod
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from st_types.errors import DeclarationError
from st_types.types.elementary import BOOL, DINT, UDINT, DataType, ElementaryType
from st_types.types.layout import StructLayout, align_up, lay_out
from st_types.types.spelling import Spellings

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

V_co = TypeVar("V_co", covariant=True)

MAX_SIZE = 0x7FFF_FFFF
"""Bytes; no variable of a 32-bit controller is larger."""

MAX_EMPTY_ELEMENTS = 0x1_0000
"""Elements of an ARRAY whose elements have no bytes; nothing else bounds it."""


class Section(Enum):
    """The VAR section a member stands in; the values give the order within a data block."""

    INPUT = 0
    OUTPUT = 1
    IN_OUT = 2
    """A reference to the caller's variable."""
    INTERNAL = 3


class Member(NamedTuple):
    """A member of a STRUCT or a data block, a variable among those of a program.

    ``initial`` None means the default of its type; a RETAIN keeps its value over a warm restart.
    """

    name: str
    data_type: DataType[object]
    initial: object = None
    section: Section = Section.INTERNAL
    is_retained: bool = False


class StringType(DataType[str]):
    """STRING[length]: ``length`` one-byte characters and a terminator.

    STRING[0] holds the terminator only: interfaces of libraries have references to it.
    """

    __slots__ = ("length",)

    def __init__(self, length: int) -> None:
        if not 0 <= length < MAX_SIZE:
            raise DeclarationError(f"STRING[{length}]: the length must be 0 or above.")
        super().__init__(f"STRING[{length}]", length + 1, 1)
        self.length = length


class WStringType(DataType[str]):
    """WSTRING[length]: ``length`` 16-bit characters and a terminator."""

    __slots__ = ("length",)

    def __init__(self, length: int) -> None:
        if not 0 <= length < MAX_SIZE // 2:
            raise DeclarationError(f"WSTRING[{length}]: the length must be 0 or above.")
        super().__init__(f"WSTRING[{length}]", 2 * (length + 1), 2)
        self.length = length


class ArrayType(DataType[V_co]):
    """ARRAY[low..high, ...] OF element, the last index running fastest.

    Attributes:
        element: type of one element.
        bounds: (low, high) of each dimension, both ends included.
        count: number of elements over all dimensions.
    """

    __slots__ = ("bounds", "count", "element")

    def __init__(self, element: DataType[object], bounds: Sequence[tuple[int, int]]) -> None:
        text = ", ".join(f"{low}..{high}" for low, high in bounds)
        name = f"ARRAY[{text}] OF {element.name}"
        if not bounds or any(low > high for low, high in bounds):
            raise DeclarationError(f"{name}: each lower bound must not be above its upper bound.")
        self.element = element
        self.bounds = tuple(bounds)
        self.count = prod(high - low + 1 for low, high in bounds)
        if self.count * element.size > MAX_SIZE:
            raise DeclarationError(f"{name}: {self.count * element.size} bytes are too many.")
        if not element.size and self.count > MAX_EMPTY_ELEMENTS:
            raise DeclarationError(f"{name}: {self.count} elements are too many.")
        super().__init__(name, self.count * element.size, element.alignment)

    def index_of(self, *indices: int) -> int:
        """Return the zero-based position of the element at ``indices``.

        Raises:
            IndexError: the number of indices is wrong, or one is outside its bounds.
        """
        if len(indices) != len(self.bounds):
            raise IndexError(f"{self.name}: {len(self.bounds)} indices wanted, not {len(indices)}.")
        position = 0
        for index, (low, high) in zip(indices, self.bounds, strict=True):
            if not low <= index <= high:
                raise IndexError(f"{self.name}: index {index} is outside {low}..{high}.")
            position = position * (high - low + 1) + index - low
        return position


class StructType(DataType[V_co]):
    """STRUCT: members in the order of declaration; names that differ in case are two members.

    Attributes:
        members: as declared.
        offsets: bytes from the start, one for each member.
        view: the class of its views (`st_types.types.views`), None before the first.
    """

    __slots__ = ("_indices", "_spellings", "members", "offsets", "view")

    def __init__(self, name: str, members: Sequence[Member]) -> None:
        self.members = tuple(members)
        self.view: type | None = None
        layout = self._laid_out()
        self.offsets = layout.offsets
        if layout.size > MAX_SIZE:
            raise DeclarationError(f"{name}: {layout.size} bytes are too many.")
        super().__init__(name, layout.size, layout.alignment)
        self._indices: dict[str, int] = {}
        for index, member in enumerate(self.members):
            if self._indices.setdefault(member.name, index) != index:
                raise DeclarationError(f"{name}: two members are called {member.name}.")
        self._spellings = Spellings(self._indices)

    def _laid_out(self) -> StructLayout:
        """Return the layout, its offsets in the order of declaration."""
        return lay_out([member.data_type for member in self.members])

    def find(self, name: str) -> tuple[Member, int]:
        """Return the member ``name``, spelled as declared, and its offset in bytes.

        Raises:
            KeyError: there is no such member.
        """
        index = self._indices[name]
        return self.members[index], self.offsets[index]

    def spelling(self, name: str) -> str | None:
        """Return how the member is declared that ``name`` stands for, None if there is none.

        It is ``name`` itself, else the only member whose name differs from it in case.
        """
        return self._spellings.of(name)


class UnionType(StructType[V_co]):
    """UNION: members that all lie at its start; the first one gives its initial value."""

    __slots__ = ()

    def _laid_out(self) -> StructLayout:
        layouts = [lay_out([member.data_type]) for member in self.members]
        alignment = max((each.alignment for each in layouts), default=1)
        size = align_up(max((each.size for each in layouts), default=0), alignment)
        return StructLayout((0,) * len(layouts), size, alignment)


class DataBlockType(StructType[V_co]):
    """The data block of a function block, laid out as the generated C struct."""

    __slots__ = ()

    def _laid_out(self) -> StructLayout:
        order = data_block_order(self.members)
        layout = lay_out([self.members[i].data_type for i in order])
        offsets = dict(zip(order, layout.offsets, strict=True))
        return layout._replace(offsets=tuple(offsets[i] for i in range(len(order))))


def data_block_order(members: Sequence[Member]) -> tuple[int, ...]:
    """Return the indices of ``members`` in the order of the generated C struct.

    Analog inputs, analog outputs, references of VAR_IN_OUT, analog internals, then digital (BOOL,
    ARRAY OF BOOL) inputs, outputs, internals; the order of declaration within each group (read off
    generated headers such as SG4/AsTCP.h, where ``enable`` comes last).
    """
    return tuple(
        sorted(
            range(len(members)),
            key=lambda i: (is_digital(members[i].data_type), members[i].section.value),
        )
    )


def is_digital(data_type: DataType[object]) -> bool:
    """Whether a type is BOOL, under another name or in an ARRAY too."""
    while isinstance(data_type, AliasType | ArrayType):
        data_type = data_type.target if isinstance(data_type, AliasType) else data_type.element
    return data_type is BOOL


class EnumerationType(DataType[V_co]):
    """An enumeration: an integer with named values, a DINT where no other type is declared.

    Attributes:
        values: value by name, in the order of declaration.
        members: the IntEnum that Python programs see, None where values are plain integers.
        base: the type that holds a value; Automation Studio knows DINT only.
    """

    __slots__ = ("_spellings", "base", "members", "values")

    def __init__(
        self,
        name: str,
        values: Mapping[str, int],
        members: type[IntEnum] | None = None,
        base: ElementaryType[int] = DINT,
    ) -> None:
        super().__init__(name, base.size, base.alignment)
        if not values:
            raise DeclarationError(f"{name}: an enumeration needs at least one value.")
        for key, value in values.items():
            if not base.minimum <= value <= base.maximum:
                raise DeclarationError(f"{name}.{key}: {value} is not a {base}.")
        self.base = base
        self.values = dict(values)
        self.members = members
        self._spellings = Spellings(self.values)

    def spelling(self, name: str) -> str | None:
        """Return how the value is declared that ``name`` stands for, as `StructType.spelling`."""
        return self._spellings.of(name)


class SubrangeType(DataType[int]):
    """An integer type whose values are meant to stay within minimum..maximum.

    The controller does not check stores, unless the project holds the IecCheck library; initial
    values are checked.
    """

    __slots__ = ("base", "maximum", "minimum")

    def __init__(self, name: str, base: ElementaryType[int], minimum: int, maximum: int) -> None:
        super().__init__(name, base.size, base.alignment)
        if not base.is_integer:
            raise DeclarationError(f"{name}: {base.name} cannot have a subrange.")
        if not base.minimum <= minimum <= maximum <= base.maximum:
            raise DeclarationError(f"{name}: {minimum}..{maximum} is not a range of {base.name}.")
        self.base = base
        self.minimum = minimum
        self.maximum = maximum


class ReferenceType(DataType[int]):
    """REFERENCE TO target, or POINTER TO target: a 32-bit address, 0 for none.

    A name of a reference means what it refers to; a pointer is followed by ``^``.

    Args:
        target: what lies at the address, None where it is not known. A function is called when
            the target is first asked for: a type may refer to itself.
        name: as it is written in a declaration.
        is_pointer: it is a POINTER TO or a REF_TO.
    """

    __slots__ = ("_find", "_target", "is_pointer")

    def __init__(
        self,
        target: DataType[object] | Callable[[], DataType[object] | None] | None,
        name: str = "",
        *,
        is_pointer: bool = False,
    ) -> None:
        self.is_pointer = is_pointer
        self._target: DataType[object] | None = None
        self._find: Callable[[], DataType[object] | None] | None = None
        if target is None or isinstance(target, DataType):
            self._target = target
        else:
            self._find = target
        super().__init__(name or f"REFERENCE TO {self._target}", UDINT.size, UDINT.alignment)

    @property
    def target(self) -> DataType[object] | None:
        """What lies at the address, None where it is not known."""
        if self._find is not None:
            find, self._find = self._find, None
            self._target = find()
        return self._target


class AliasType(DataType[V_co]):
    """Another name of ``target``, possibly with an initial value of its own."""

    __slots__ = ("initial", "target")

    def __init__(self, name: str, target: DataType[V_co], initial: object = None) -> None:
        super().__init__(name, target.size, target.alignment)
        self.target = target
        self.initial = initial


def resolve_alias(data_type: DataType[V_co]) -> DataType[V_co]:
    """Return the type behind any number of aliases."""
    while isinstance(data_type, AliasType):
        data_type = data_type.target
    return data_type
