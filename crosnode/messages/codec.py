"""Messages to bytes and back."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final, TypeGuard

from crosnode.errors import DecodeError, DefinitionError, MessageValueError
from crosnode.messages.compiled import Shape, least_size, make_decoder, make_encoder
from crosnode.messages.definition import Definition, Field
from crosnode.messages.message import Message, attribute_name, message_class
from crosnode.messages.values import DTYPES, Duration, Time, check_scalar, coerce_array

if TYPE_CHECKING:
    from collections.abc import Callable

MAX_FIXED: Final = 4096
"""Elements of a fixed array of strings or messages, all of which each message has."""

_ENCODE_FAULTS: Final = (
    struct.error,
    AttributeError,
    LookupError,
    OverflowError,
    TypeError,
    ValueError,
)
"""What comes of a message that does not fit; ``Codec.encode`` says why."""

_DECODE_FAULTS: Final = (struct.error, ValueError)

_TIMES: Final[tuple[tuple[str, str, type[Time] | type[Duration]], ...]] = (
    ("time", "uint32", Time),
    ("duration", "int32", Duration),
)


class Codec:
    """Encoders and decoders of message types.

    Definitions are added after those that they depend on. A type is compiled when it is added,
    which takes a part of a millisecond: do it before the first cycle.
    """

    def __init__(self) -> None:
        self._shapes: dict[str, Shape] = {}
        self._classes: dict[str, Callable[[], Any]] = {}
        for name, seconds, cls in _TIMES:
            fields = (Field("secs", seconds, seconds), Field("nsecs", seconds, seconds))
            self._add(Definition(name, "", (), fields), cls)

    def add(self, definition: Definition) -> type[Message]:
        """Make the class of a message type whose dependencies were added before.

        Raises:
            DefinitionError: fields that cannot be attributes, or a fixed array that is too long.
        """
        for field in definition.fields:
            _check_array(definition.name, field)
        cls = message_class(definition, self._classes)
        self._add(definition, cls)
        return cls

    def _add(self, definition: Definition, cls: type[Any]) -> None:
        fields = definition.fields
        inner = [self._shapes[each.base] for each in fields if each.base in self._shapes]
        self._classes[definition.name] = cls
        self._shapes[definition.name] = Shape(
            definition,
            cls,
            least=sum(least_size(field, self._shapes) for field in fields),
            weight=len(fields) + sum(shape.weight for shape in inner),
            encode=make_encoder(definition, self._shapes),
            decode=make_decoder(definition, cls, self._shapes),
        )

    def warm(self, name: str) -> None:
        """Run the code of a type once, so that the first message does not pay for it."""
        self.decode(name, self.encode(name, self._classes[name]()))

    def encode(self, name: str, message: object) -> bytes:
        """Return the bytes of a message.

        Raises:
            MessageValueError: a field cannot hold its value; the message names the field.
        """
        pieces: list[Any] = []
        try:
            self._shapes[name].encode(message, pieces.append)
        except _ENCODE_FAULTS as error:
            fault = self._fault(name, message) or f": {error}"
            raise MessageValueError(f"{name}{fault}.") from error
        return pieces[0] if len(pieces) == 1 and type(pieces[0]) is bytes else b"".join(pieces)

    def decode(self, name: str, data: bytes | bytearray | memoryview) -> Message:
        """Return the message that ``data`` holds.

        Numeric arrays of the message are read-only views of ``data`` where that is ``bytes`` or a
        read-only view, which must not change any more, of a copy otherwise. What the bytes claim
        to hold is never allocated before it is there. A string that is not UTF-8 is kept byte for
        byte (`crosnode.messages.text`).

        Raises:
            DecodeError: too few or too many bytes.
        """
        raw = data if type(data) is bytes or _is_read_only(data) else bytes(data)
        end = len(raw)
        message: Message
        try:
            message, position = self._shapes[name].decode(raw, 0, end)
        except _DECODE_FAULTS as error:
            raise DecodeError(f"{name}: {error}") from error
        if position != end:
            raise DecodeError(f"{name}: {end - position} bytes behind the message")
        return message

    def _fault(self, name: str, message: object) -> str | None:
        """Return path and reason of the first field that cannot be encoded."""
        for field in self._shapes[name].definition.fields:
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
        if base in self._shapes:
            if isinstance(value, Mapping):
                return f": expected a message {base}, got {type(value).__name__}"
            return self._fault(base, value)
        try:
            check_scalar(base, value)
        except (TypeError, ValueError) as error:
            return f": {error}"
        return None


def _check_array(name: str, field: Field) -> None:
    if field.base not in DTYPES and (field.length or 0) > MAX_FIXED:
        raise DefinitionError(f"{name}.{field.name}: array of more than {MAX_FIXED} {field.base}.")


def _is_read_only(data: bytes | bytearray | memoryview) -> TypeGuard[memoryview]:
    return isinstance(data, memoryview) and data.readonly
