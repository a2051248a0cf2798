"""Typed views: Python attributes over bytes that lie as on the controller.

A STRUCT is a class::

    class Motor(Struct):
        speed = var(REAL)
        name = var(STRING(20), "conveyor")

``motor.speed = 1.5`` writes the four bytes in place. Integers wrap as they do on the controller,
STRINGs are cut to their length, an index outside its bounds raises IndexError, and a name that was
not declared raises AttributeError. A view either lies in PLC memory (`Struct.bind`) or, made by
calling the class, in memory of its own.

The class is a ``ctypes.Structure``, so that an elementary member is read and written by C code;
members of other types become properties.
"""

from __future__ import annotations

import ctypes
from enum import IntEnum
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar, Final, NamedTuple, Self, TypeVar, cast, overload

from st_types.errors import DeclarationError, ValueRangeError
from st_types.types.arrays import Array, BoolArray, ConvertedArray, ViewArray
from st_types.types.derived import (
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StringType,
    StructType,
    UnionType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import BOOL, UDINT, DataType
from st_types.types.slots import Slot, slot_of
from st_types.types.values import encode

if TYPE_CHECKING:
    from _ctypes import _CData
    from _ctypes import _PyCStructType as _CStructMeta
    from collections.abc import Callable, Iterator

    class _CStruct(_CData, metaclass=_CStructMeta):
        """ctypes.Structure without __getattr__, so that mypy refuses a name not declared."""

        def __init__(self) -> None: ...
else:
    _CStruct = ctypes.Structure
    _CStructMeta = type(ctypes.Structure)  # ctypes does not export its metaclass

V = TypeVar("V")
S = TypeVar("S", bound="Struct")
E = TypeVar("E", bound=IntEnum)


class _Declaration(NamedTuple):
    """What `var` leaves in a class body until the class is made."""

    data_type: DataType[object]
    initial: object
    section: Section
    is_retained: bool = False


def _type_in(declared: object) -> DataType[object]:
    if isinstance(declared, DataType):
        return declared
    if isinstance(declared, type) and issubclass(declared, Struct):
        return type_of(declared)
    raise DeclarationError(f"{declared!r} is not a data type.")


def _declare(
    data_type: object, initial: object, section: Section, *, is_retained: bool = False
) -> Any:
    return _Declaration(_type_in(data_type), initial, section, is_retained)


@overload
def var(data_type: type[S], initial: object = None, *, retain: bool = False) -> S: ...
@overload
def var(data_type: DataType[V], initial: object = None, *, retain: bool = False) -> V: ...
def var(data_type: object, initial: object = None, *, retain: bool = False) -> object:
    """Declare a variable in the body of a `Struct`, a program or a function block.

    Args:
        data_type: ``UINT``, ``STRING(20)``, ``ARRAY(REAL, (1, 5))``, ... or a Struct class.
        initial: value after a restart; None gives that of the type. Members of a STRUCT are given
            as a mapping, elements of an ARRAY as a sequence.
        retain: it keeps its value over a warm restart (VAR RETAIN).
    """
    return _declare(data_type, initial, Section.INTERNAL, is_retained=retain)


@overload
def var_input(data_type: type[S], initial: object = None) -> S: ...
@overload
def var_input(data_type: DataType[V], initial: object = None) -> V: ...
def var_input(data_type: object, initial: object = None) -> object:
    """Declare an input (VAR_INPUT) of a function block; arguments as for `var`."""
    return _declare(data_type, initial, Section.INPUT)


@overload
def var_output(data_type: type[S], initial: object = None) -> S: ...
@overload
def var_output(data_type: DataType[V], initial: object = None) -> V: ...
def var_output(data_type: object, initial: object = None) -> object:
    """Declare an output (VAR_OUTPUT) of a function block; arguments as for `var`."""
    return _declare(data_type, initial, Section.OUTPUT)


def var_in_out(reference: DataType[int]) -> int:
    """Declare a VAR_IN_OUT of a function block: the caller assigns the address of its variable.

    Args:
        reference: a `st_types.types.derived.ReferenceType`, or UDINT for an address of any type.

    Raises:
        DeclarationError: it is another type.
    """
    if reference is not UDINT and not isinstance(reference, ReferenceType):
        raise DeclarationError(f"{reference} is no address; a reference or UDINT was expected.")
    declared: int = _declare(reference, None, Section.IN_OUT)
    return declared


def STRING(length: int) -> StringType:  # noqa: N802  # the IEC keyword
    """Return the type STRING[length]: ``length`` one-byte characters."""
    return StringType(_length(length, "STRING"))


def WSTRING(length: int) -> WStringType:  # noqa: N802  # the IEC keyword
    """Return the type WSTRING[length]: ``length`` 16-bit characters."""
    return WStringType(_length(length, "WSTRING"))


def _length(length: object, name: str) -> int:
    if not isinstance(length, int):
        raise DeclarationError(f"{name}({length!r}): a number of characters was expected.")
    return length


@overload
def ARRAY(element: type[S], *bounds: tuple[int, int]) -> ArrayType[Array[S]]: ...
@overload
def ARRAY(element: DataType[V], *bounds: tuple[int, int]) -> ArrayType[Array[V]]: ...
def ARRAY(element: object, *bounds: Any) -> ArrayType[Any]:  # noqa: N802  # the IEC keyword
    """Return the type ARRAY[low..high, ...] OF element; both bounds are included.

    Raises:
        DeclarationError: ``element`` is no type, or ``bounds`` are no pairs of integers.
    """
    data_type = _type_in(element)
    if all(_is_bounds(each) for each in bounds):
        return ArrayType(data_type, bounds)
    count = bounds[0]
    hint = ""
    if isinstance(count, int) and count > 0:
        hint = f"; {count} elements are ARRAY({data_type}, (0, {count - 1}))"
    raise DeclarationError(
        f"ARRAY({data_type}, {', '.join(map(repr, bounds))}): each dimension is a pair, "
        f"(low, high){hint}."
    )


def _is_bounds(given: Any) -> bool:
    is_pair = isinstance(given, tuple) and len(given) == 2
    return is_pair and all(isinstance(bound, int) for bound in given)


def ENUM(values: type[E]) -> EnumerationType[E]:  # noqa: N802  # an IEC type constructor
    """Return the enumeration type of an IntEnum; variables read back as its members."""
    return EnumerationType(values.__name__, {v.name: v.value for v in values}, values)


_EMPTY: StructType[Any] = StructType("empty STRUCT", ())


class _StructMeta(_CStructMeta):
    """Turns the declarations in a class body into a laid-out ctypes structure.

    A class whose body names its type, ``_plc_type = ...``, is a *face* of that type: declarations
    elsewhere (a .fun, a .typ) say what its members are. A subclass of a face that has its name is
    what the face stands for, the body of a function block for example: it has the same type, and is
    the class of all views of that type from then on.
    """

    def __new__(mcs, name: str, bases: tuple[type, ...], body: dict[str, Any]) -> Any:
        declared = {k: v for k, v in body.items() if isinstance(v, _Declaration)}
        base = next((b for b in bases if isinstance(b, _StructMeta)), None)
        inherited: tuple[Member, ...] = getattr(base, "_plc_type", _EMPTY).members
        if declared and inherited:
            raise DeclarationError(f"{name}: {base} has variables already; nest it instead.")
        is_face = "_plc_type" in body
        if inherited or base is None:
            body.setdefault("__slots__", ())
        else:
            data_type = body.get("_plc_type") or _declared_type(name, base, declared)
            body = {k: v for k, v in body.items() if k not in declared}
            body |= _structure_body(data_type, body)
        made: Any = super().__new__(mcs, name, bases, body)
        if inherited and not _stands_for(base, name):
            made._plc_type = _kind(base)(name, inherited)
        made._plc_is_face = is_face
        if base is not None:
            made._plc_type.view = made
        return made


def _stands_for(base: Any, name: str) -> bool:
    """Whether a subclass of this name is what its base is the face of."""
    return bool(base._plc_is_face and base._plc_type.name == name)


def _kind(base: object) -> type[StructType[Any]]:
    kind: type[StructType[Any]] = getattr(base, "_plc_kind", StructType)
    return kind


def _declared_type(name: str, base: object, declared: dict[str, _Declaration]) -> StructType[Any]:
    """Return the type of the declarations in a class body, initial values checked."""
    taken = next((k for k in declared if hasattr(base, k)), None)
    if taken is not None:
        raise DeclarationError(f"{name}.{taken}: a method of {base} has this name.")
    data_type = _kind(base)(name, [Member(k, *d) for k, d in declared.items()])
    try:
        encode(data_type, None)
    except ValueRangeError as err:
        raise DeclarationError(f"{name}{err}") from None
    return data_type


def _structure_body(data_type: StructType[Any], body: dict[str, Any]) -> dict[str, Any]:
    """Return the class attributes that make a ctypes structure of ``data_type``."""
    is_union = isinstance(data_type, UnionType)
    fields: list[tuple[str, Any]] = []
    views: list[tuple[str, DataType[object], int]] = []
    attributes: dict[str, Any] = {}
    end = 0
    members = zip(data_type.offsets, data_type.members, strict=True)
    for offset, member in members if is_union else sorted(members):
        slot = slot_of(member.data_type)
        if slot is None:
            views.append((f"_plc_v_{member.name}", resolve_alias(member.data_type), offset))
            attributes[member.name] = _view_property(member.name)
            continue
        if offset > end:
            fields.append((f"_plc_gap_{end}", ctypes.c_ubyte * (offset - end)))
        field = member.name if slot.load is None else f"_plc_f_{member.name}"
        fields.append((field, slot.ctype))
        if slot.load is not None:
            attributes[member.name] = _converting_property(field, slot)
        end = offset + member.data_type.size
    if is_union:
        fields = [("_plc_union", type("Fields", (ctypes.Union,), {"_fields_": fields}))]
        end = data_type.size
        attributes["_anonymous_"] = ["_plc_union"]
    if end < data_type.size:
        fields.append((f"_plc_gap_{end}", ctypes.c_ubyte * (data_type.size - end)))
    if not data_type.members:
        fields.clear()  # so that subclasses start at offset 0
    slots = tuple(body.get("__slots__", ())) + tuple(view for view, _, _ in views)
    return attributes | {
        "__slots__": slots,
        "_plc_type": data_type,
        "_plc_views": tuple(views),
        "_pack_": 1,
        "_layout_": "ms",
        "_fields_": fields,
    }


def _view_property(name: str) -> property:
    """Return a property that answers the view and assigns by copying the bytes."""
    load = attrgetter(f"_plc_v_{name}")

    def store(self: object, value: object) -> None:
        assign(load(self), value)

    return property(load, store)


def _converting_property(field: str, slot: Slot) -> property:
    """Return a property that converts between the stored bytes and the Python value."""
    raw = attrgetter(field)
    to_value = cast("Callable[[Any], object]", slot.load)
    to_raw = cast("Callable[[Any], object]", slot.store)

    def load(self: object) -> object:
        return to_value(raw(self))

    def store(self: object, value: object) -> None:
        setattr(self, field, to_raw(value))

    return property(load, store)


class Struct(_CStruct, metaclass=_StructMeta):
    """Base of all views of structured variables."""

    __slots__ = ("_plc_address", "_plc_context")

    _plc_kind: ClassVar[type[StructType[Any]]] = StructType
    _plc_type: ClassVar[StructType[Any]]
    _plc_is_face: ClassVar[bool]
    _plc_views: ClassVar[tuple[tuple[str, DataType[object], int], ...]] = ()
    _plc_address: int
    _plc_context: object

    def __init__(self, **values: object) -> None:
        super().__init__()
        self._plc_attach(self, 0, 0, None)
        reset(self)
        for name, value in values.items():
            try:
                setattr(self, name, value)
            except TypeError:
                raise refused(self, name, value) from None

    @classmethod
    def bind(cls, buffer: Any, offset: int, address: int, context: object = None) -> Self:
        """Return a view of the bytes at ``offset`` of a writable ``buffer``.

        Args:
            buffer: writable buffer; the caller sees to it that the bytes are inside.
            offset: bytes from its start.
            address: what ADR() gives for this variable; 0 where it has no PLC address.
            context: what function blocks inside the variable are to work with.
        """
        return _bind(cls, buffer, offset, address, context)

    def _plc_attach(self, buffer: Any, offset: int, address: int, context: object) -> None:
        self._plc_address = address
        self._plc_context = context
        for slot, data_type, at in self._plc_views:
            inner = address + at if address else 0
            setattr(self, slot, view_of(data_type, buffer, offset + at, inner, context))

    def __repr__(self) -> str:
        try:
            values = ", ".join(f"{m.name}={getattr(self, m.name)!r}" for m in self._members())
        except AttributeError:
            values = "not bound"
        return f"{type(self).__name__}({values})"

    def _members(self) -> Iterator[Member]:
        return iter(getattr(self, "_plc_type", _EMPTY).members)


def _bind(view: type[S], buffer: Any, offset: int, address: int, context: object) -> S:
    # Looked up on the metaclass, because a declared member may be called from_buffer or bind.
    bound: S = _CStructMeta.from_buffer(view, buffer, offset)
    bound._plc_attach(buffer, offset, address, context)
    return bound


class Union(Struct):
    """Base of all views of UNIONs: their members lie at one place."""

    __slots__ = ()

    _plc_kind = UnionType


class DataBlock(Struct):
    """Base of the data blocks of function blocks: laid out as the generated C struct."""

    _plc_kind = DataBlockType


def type_of(view: Struct | Array[Any] | type[Struct] | DataType[object]) -> DataType[Any]:
    """Return the data type of a view, of a Struct class, or the type itself."""
    if isinstance(view, DataType):
        return view
    if isinstance(view, Array):
        return view.data_type
    found: StructType[Any] = getattr(view, "_plc_type", _EMPTY)
    return found


def address_of(view: Struct | Array[Any]) -> int:
    """Return the PLC address of a view, 0 where it does not lie in PLC memory."""
    return view.address if isinstance(view, Array) else view._plc_address


def context_of(view: Struct) -> Any:
    """Return what the view was bound with, None where it lies in memory of its own."""
    return view._plc_context


def assign(view: Struct | Array[Any], value: object) -> None:
    """Copy ``value`` into ``view``.

    Args:
        view: what is overwritten.
        value: another view of the same type, a mapping of members for a STRUCT, a sequence of
            elements for an ARRAY; what is not given gets its initial value.

    Raises:
        TypeError: the value is of another type.
        ValueRangeError: a member or an element does not fit.
    """
    if isinstance(view, Array):
        view.assign(value)
        return
    if isinstance(value, Struct) and type_of(value) is type_of(view):
        data = bytes(value)
    elif isinstance(value, dict):
        data = encode(type_of(view), value)
    else:
        raise TypeError(f"{type_of(view)} cannot take {value!r}.")
    ctypes.memmove(ctypes.addressof(view), data, type_of(view).size)


def refused(view: Struct, name: str, value: object) -> ValueRangeError:
    """Return what to raise where ctypes raised TypeError, for a member that cannot take a value."""
    data_type: StructType[Any] = type_of(view)  # type: ignore[assignment]  # that of a Struct
    return ValueRangeError(
        f"{name} is {data_type.find(name)[0].data_type} and cannot be {value!r}."
    )


def reset(view: Struct) -> None:
    """Give all members their initial values."""
    data_type = type_of(view)
    ctypes.memmove(ctypes.addressof(view), encode(data_type, None), data_type.size)


_BASES: Final = {DataBlockType: DataBlock, UnionType: Union}


def view_class(data_type: StructType[Any]) -> type[Struct]:
    """Return the view class of a STRUCT or data block type, made at the first call."""
    if data_type.view is None:
        base = _BASES.get(type(data_type), Struct)
        _StructMeta(data_type.name, (base,), {"_plc_type": data_type})
    return cast("type[Struct]", data_type.view)


def view_of(
    data_type: DataType[object], buffer: Any, offset: int, address: int, context: object
) -> Struct | Array[Any]:
    """Return a view of a STRUCT, data block or ARRAY; arguments as for `Struct.bind`."""
    if isinstance(data_type, ArrayType):
        return _array_of(data_type, buffer, offset, address, context)
    view = view_class(cast("StructType[Any]", data_type))
    return _bind(view, buffer, offset, address, context)


def _array_of(
    data_type: ArrayType[Any], buffer: Any, offset: int, address: int, context: object
) -> Array[Any]:
    element = resolve_alias(data_type.element)
    slot = slot_of(element)
    if slot is None:
        size = element.size

        def make(position: int) -> Struct | Array[Any]:
            inner = address + position * size if address else 0
            return view_of(element, buffer, offset + position * size, inner, context)

        raw = (ctypes.c_ubyte * data_type.size).from_buffer(buffer, offset)
        return ViewArray(data_type, raw, address, make, assign)
    raw = (slot.ctype * data_type.count).from_buffer(buffer, offset)
    if element is BOOL:
        return BoolArray(data_type, raw, address)
    if slot.load is None:
        return Array(data_type, raw, address)
    return ConvertedArray(data_type, raw, address, slot.load)
