"""Messages to bytes and back: rosbags' ROS 1 codec behind classes of our own.

rosbags compiles a serialiser and a deserialiser per type from a list of fields. The fields come
from our parser and the classes are made here, which gives what rosbags lacks: defaults, unsigned
seconds, equality over arrays, coerced arrays, constants and names that its grammar refuses, and no
generated module in ``sys.modules``. Field names reach generated code, so ``definition`` admits
ASCII identifiers only.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from copy import copy
from dataclasses import field as dataclass_field
from dataclasses import fields as dataclass_fields
from dataclasses import make_dataclass
from keyword import iskeyword
from typing import TYPE_CHECKING, Any, Final, TypeAlias, TypeGuard, cast

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.serde import SerdeError
from rosbags.typesys.store import Typestore

from crosnode.errors import DecodeError, DefinitionError, MessageValueError
from crosnode.messages.definition import BUILTINS, Definition, Field
from crosnode.messages.text import EscapedBytes, escaped
from crosnode.messages.values import DTYPES, Duration, Time, check_scalar, coerce_array

if TYPE_CHECKING:
    from rosbags.interfaces.typing import BaseDesc, FieldDesc, NameDesc
    from rosbags.typesys.store import MsgType

Prepare: TypeAlias = Callable[[Any], Any]

MAX_UNROLLED: Final = 4096
"""Elements of a fixed array of strings or messages; rosbags writes code for each of them."""

_ENCODE_FAULTS: Final = (
    SerdeError,
    struct.error,
    AttributeError,
    LookupError,
    OverflowError,
    TypeError,
    ValueError,
)
"""What rosbags raises for a message that does not fit; ``Codec.encode`` says why."""

_PLACEHOLDER: Final[tuple[str, FieldDesc]] = (
    "structure_needs_at_least_one_member",
    (Nodetype.BASE, ("uint8", 0)),
)
"""The member by which rosbags knows an empty message; in ROS 1 it takes no bytes."""

_SCALARS: Final[dict[str, bool | int | float | str]] = {
    "bool": False,
    "string": "",
    "float32": 0.0,
    "float64": 0.0,
}


class Message:
    """Base of all message classes; fields are attributes, all with defaults.

    A field whose name is a Python keyword has an underscore appended. Two messages are equal when
    they are of one type and all fields are equal, arrays element by element.
    """

    __slots__ = ()
    __hash__ = None  # type: ignore[assignment]  # messages are mutable

    if TYPE_CHECKING:  # the fields of a type are known only at run time

        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        names = [field.name for field in dataclass_fields(cast("Any", self))]
        return all(_equal(getattr(self, name), getattr(other, name)) for name in names)


def _equal(a: object, b: object) -> bool:
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.array_equal(cast("Any", a), cast("Any", b))
    return a == b


def attribute_name(field_name: str) -> str:
    """Return the attribute that holds a field: its name, or ``name_`` for a keyword."""
    return f"{field_name}_" if iskeyword(field_name) else field_name


class Codec:
    """Encoders and decoders of message types, in one rosbags store.

    Definitions are added after those that they depend on. A type is compiled at its first use,
    which takes milliseconds: call ``warm`` before the first cycle.
    """

    def __init__(self) -> None:
        self._store = Typestore()
        self._definitions: dict[str, Definition] = {}
        self._prepare: dict[str, Prepare | None] = {}
        self._least_size = {"time": 8, "duration": 8}
        for name, seconds, cls in (("time", "uint32", Time), ("duration", "int32", Duration)):
            fields = (Field("secs", seconds, seconds), Field("nsecs", seconds, seconds))
            self._register(Definition(name, "", (), fields), cls)

    def add(self, definition: Definition) -> type[Message]:
        """Make the class of a message type whose dependencies were added before.

        Raises:
            DefinitionError: fields that cannot be attributes, or arrays we do not decode.
        """
        for field in definition.fields:
            self._check_array(definition.name, field)
        cls = self._make_class(definition)
        self._register(definition, cls)
        self._least_size[definition.name] = sum(map(self._least, definition.fields))
        return cls

    def warm(self, name: str) -> None:
        """Compile a type and all it depends on, and run it once."""
        cls = self._store.types[name]
        self.decode(name, bytes(self.encode(name, cls())))

    @property
    def compiled(self) -> frozenset[str]:
        """Names of the types that are compiled."""
        return frozenset(self._store.cache)

    def encode(self, name: str, message: object) -> memoryview:
        """Return the bytes of a message, read-only, without a copy.

        Raises:
            MessageValueError: a field cannot hold its value; the message names the field.
        """
        prepare = self._prepare[name]
        self._store.get_msgdef(name)  # compiles; its errors are no fault of the message
        try:
            prepared = message if prepare is None else prepare(message)
            try:
                return self._store.serialize_ros1(prepared, name)
            except UnicodeEncodeError:
                return self._store.serialize_ros1(escaped(prepared), name)
        except _ENCODE_FAULTS as error:
            fault = self._fault(name, message) or f": {error}"
            raise MessageValueError(f"{name}{fault}.") from error

    def decode(self, name: str, data: bytes | bytearray | memoryview) -> Message:
        """Return the message that ``data`` holds.

        Numeric arrays of the message are read-only views of ``data`` where that is ``bytes`` or a
        read-only view, which must not change any more, of a copy otherwise. What the bytes claim
        to hold is never allocated before it is there. A string that is not UTF-8 is kept byte for
        byte (`crosnode.messages.text`).

        Raises:
            DecodeError: too few or too many bytes.
        """
        raw = data if isinstance(data, bytes) or _is_read_only(data) else bytes(data)
        try:
            try:
                return cast("Message", self._store.deserialize_ros1(raw, name))
            except SerdeError as error:
                if not isinstance(error.__cause__, UnicodeDecodeError):
                    raise
                return cast("Message", self._store.deserialize_ros1(EscapedBytes(raw), name))
        except (SerdeError, struct.error, ValueError) as error:
            raise DecodeError(f"{name}: {error.__cause__ or error}") from error

    def _register(self, definition: Definition, cls: type[Message | Time | Duration]) -> None:
        name = definition.name
        self._definitions[name] = definition
        self._prepare[name] = self._preparation(definition)
        self._store.types[name] = cast("type[MsgType]", cls)
        fields = [(field.name, _descriptor(field)) for field in definition.fields]
        self._store.fielddefs[name] = ([], fields or [_PLACEHOLDER])

    def _check_array(self, name: str, field: Field) -> None:
        if not field.is_array or field.base in DTYPES:
            return
        if field.length is not None and field.length > MAX_UNROLLED:
            raise DefinitionError(
                f"{name}.{field.name}: fixed array of more than {MAX_UNROLLED} {field.base}."
            )
        if field.length is None and self._least(field._replace(is_array=False)) == 0:
            # Its length would be the only thing on the wire: four bytes could ask for gigabytes.
            raise DefinitionError(f"{name}.{field.name}: variable array of empty messages.")

    def _least(self, field: Field) -> int:
        if field.is_array and field.length is None:
            return 4
        one = 4 if field.base == "string" else self._least_size.get(field.base)
        if one is None:
            one = DTYPES[field.base].itemsize
        return one * (1 if field.length is None else field.length)

    def _make_class(self, definition: Definition) -> type[Message]:
        members: list[tuple[str, Any, Any]] = []
        for field in definition.fields:
            default = dataclass_field(default_factory=self._default(field))
            members.append((attribute_name(field.name), Any, default))
        _, _, base = definition.name.partition("/")
        namespace = {"__msgtype__": definition.name, "__doc__": definition.name}
        try:
            return make_dataclass(
                base, members, bases=(Message,), namespace=namespace, eq=False, slots=True
            )
        except TypeError as error:
            raise DefinitionError(f"{definition.name}: {error}.") from error

    def _default(self, field: Field) -> Callable[[], object]:
        one = self._default_one(field.base)
        if not field.is_array:
            return one
        length = field.length or 0
        if field.base in DTYPES:
            return lambda: np.zeros(length, DTYPES[field.base])
        return lambda: [one() for _ in range(length)]

    def _default_one(self, base: str) -> Callable[[], object]:
        if base in self._store.types:
            return self._store.types[base]
        return lambda: _SCALARS.get(base, 0)

    def _preparation(self, definition: Definition) -> Prepare | None:
        """Return what makes a message fit for rosbags, None where nothing is to be done."""
        steps = {
            attribute_name(field.name): step
            for field in definition.fields
            if (step := self._field_preparation(field))
        }
        return (lambda message: _prepared(message, steps)) if steps else None

    def _field_preparation(self, field: Field) -> Prepare | None:
        if field.base in DTYPES:
            base, length = field.base, field.length
            return (lambda value: coerce_array(base, length, value)) if field.is_array else None
        one = None if field.base in BUILTINS else self._prepare[field.base]
        if one and field.is_array:
            return lambda values: _prepared_list(values, one)
        return one

    def _fault(self, name: str, message: object) -> str | None:
        """Return path and reason of the first field that cannot be encoded."""
        for field in self._definitions[name].fields:
            attribute = attribute_name(field.name)
            if not hasattr(message, attribute):
                return f".{attribute}: missing in {type(message).__name__}"
            if fault := self._field_fault(field, getattr(message, attribute)):
                return f".{attribute}{fault}"
        return None

    def _field_fault(self, field: Field, value: object) -> str | None:
        try:
            if not field.is_array:
                return self._element_fault(field.base, value)
            if field.base in DTYPES:
                coerce_array(field.base, field.length, value)
                return None
            return self._list_fault(field, value)
        except (TypeError, ValueError, OverflowError) as error:
            return f": {error}"

    def _list_fault(self, field: Field, value: object) -> str | None:
        if not isinstance(value, (list, tuple)):
            return f": expected a list, got {type(value).__name__}"
        if field.length is not None and len(value) != field.length:
            return f": expected {field.length} elements, got {len(value)}"
        for index, element in enumerate(value):
            if fault := self._element_fault(field.base, element):
                return f"[{index}]{fault}"
        return None

    def _element_fault(self, base: str, value: object) -> str | None:
        if base in self._definitions:
            return self._fault(base, value)
        try:
            check_scalar(base, value)
        except (TypeError, ValueError) as error:
            return f": {error}"
        return None


def _is_read_only(data: bytearray | memoryview) -> TypeGuard[memoryview]:
    return isinstance(data, memoryview) and data.readonly


def _prepared(message: Any, steps: Mapping[str, Prepare]) -> Any:
    """Return ``message``, or a shallow copy where a step changed a field.

    The message of the program is left as it is: its lists stay lists.
    """
    result = message
    for name, step in steps.items():
        value = getattr(message, name)
        prepared = step(value)
        if prepared is not value:
            result = copy(message) if result is message else result
            setattr(result, name, prepared)
    return result


def _prepared_list(values: Any, one: Prepare) -> Any:
    prepared = [one(value) for value in values]
    same = all(a is b for a, b in zip(values, prepared, strict=True))
    return values if same else prepared


def _descriptor(field: Field) -> FieldDesc:
    inner: BaseDesc | NameDesc
    if field.base in DTYPES or field.base == "string":
        inner = (Nodetype.BASE, (cast("Any", field.base), 0))
    else:
        inner = (Nodetype.NAME, field.base)
    if not field.is_array:
        return inner
    if field.length is None:
        return (Nodetype.SEQUENCE, (inner, 0))
    return (Nodetype.ARRAY, (inner, field.length))
