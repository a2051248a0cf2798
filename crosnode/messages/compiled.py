"""Encoders and decoders of messages as functions that are written for each type.

A message is a run of numbers, a string, a run of numbers and so on: each run is one call of a
`struct.Struct`, whatever messages its fields lie in, and the number of bytes of a string or of
elements of an array ends the run before it. So the work for a message is about as many calls as it
has strings and arrays. The text of a function is made of field names, which are ASCII identifiers
(`crosnode.messages.definition`), and of names made here, which begin with an underscore.

What a message claims to hold is not allocated before it is there.
"""

from __future__ import annotations

from struct import Struct
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np

from crosnode.messages.arrays import CODES, EMPTY, NUMBERS, PACKERS
from crosnode.messages.message import attribute_name
from crosnode.messages.text import ESCAPE
from crosnode.messages.values import DTYPES

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from crosnode.messages.definition import Definition, Field

INLINE: Final = 64
"""Fields of a message that are written in the place of its field; a larger one is a function."""

MAX_LOOPS: Final = 4
"""Loops within each other; Python allows 20 blocks."""

MAX_EMPTY: Final = 65_536
"""Elements of a variable array of messages that take no bytes: four bytes ask for any number."""

TIME_CODES: Final = {"time": "I", "duration": "i"}

_COUNT: Final = Struct("<I")


class Shape(NamedTuple):
    """What is known of a message type that others contain.

    Attributes:
        definition: its fields.
        cls: its class.
        least: bytes that each message takes at least.
        weight: fields in it and in all messages in it.
        encode: its encoder, ``encode(message, add)``.
        decode: its decoder, ``decode(data, position, end)``, gives the message and the position
            behind it.
    """

    definition: Definition
    cls: Callable[..., Any]
    least: int
    weight: int
    encode: Callable[..., None]
    decode: Callable[..., tuple[Any, int]]


Shapes = "Mapping[str, Shape]"


def least_size(field: Field, shapes: Mapping[str, Shape]) -> int:
    """Return the bytes that a field takes at least."""
    if field.is_array and field.length is None:
        return 4
    if field.base == "string":
        one = 4
    elif field.base in TIME_CODES:
        one = 8
    else:
        is_number = field.base in DTYPES
        one = DTYPES[field.base].itemsize if is_number else shapes[field.base].least
    return one * (1 if field.length is None else field.length)


class _Writer:
    """The text of a function, and the objects that it names.

    Args:
        shapes: of the messages in fields, by name.
    """

    def __init__(self, shapes: Mapping[str, Shape]) -> None:
        self.shapes = shapes
        self.names: dict[str, Any] = {}
        self._lines: list[str] = []
        self._run: list[tuple[str, str]] = []
        self._count = 0
        self._depth = 1

    def line(self, text: str) -> None:
        """Add a line."""
        self._lines.append("    " * self._depth + text)

    def local(self) -> str:
        """Return a new name of a variable."""
        self._count += 1
        return f"_{self._count}"

    def named(self, prefix: str, thing: Any) -> str:
        """Return the name by which the function reaches an object."""
        for name, known in self.names.items():
            if known is thing:
                return name
        self._count += 1
        name = f"_{prefix}{self._count}"
        self.names[name] = thing
        return name

    def inlines(self, shape: Shape) -> bool:
        """Whether the fields of a message are written where it stands."""
        return shape.weight <= INLINE and self._depth <= MAX_LOOPS

    def made(self, head: str) -> Callable[..., Any]:
        """Return the function."""
        scope: dict[str, Any] = dict(self.names)
        exec("\n".join([head, *self._lines]), scope)  # noqa: S102  # see the docstring of the module
        function: Callable[..., Any] = scope["_function"]
        return function


class _EncoderWriter(_Writer):
    """Writes ``_function(_m, _add)``, which hands the pieces of a message to ``_add``."""

    def message(self, definition: Definition, message: str) -> None:
        """Write all fields of a message."""
        for field in definition.fields:
            self._field(field, f"{message}.{attribute_name(field.name)}")

    def _field(self, field: Field, value: str) -> None:
        if field.is_array:
            self.flush()
            self._array(field, value)
        else:
            self._one(field.base, value)

    def _one(self, base: str, value: str) -> None:
        if base in CODES:
            number = f"{self.named('numbers', NUMBERS)}[{value}]" if base == "bool" else value
            self._run.append((CODES[base], number))
        elif base in TIME_CODES:
            code, time = TIME_CODES[base], self.local()
            self.line(f"{time} = {value}")
            self._run += [(code, f"{time}.secs"), (code, f"{time}.nsecs")]
        elif base == "string":
            data = self.local()
            self.line(f"{data} = {value}.encode('utf-8', '{ESCAPE}')")
            self._run.append(("I", f"len({data})"))
            self.flush()
            self.line(f"_add({data})")
        else:
            self._inner(self.shapes[base], value)

    def _inner(self, shape: Shape, value: str) -> None:
        if self.inlines(shape):
            inner = self.local()
            self.line(f"{inner} = {value}")
            self.message(shape.definition, inner)
        else:
            self.flush()
            self.line(f"{self.named('encode', shape.encode)}({value}, _add)")

    def _array(self, field: Field, value: str) -> None:
        if field.base in PACKERS:
            packer = PACKERS[field.base]
            if field.length is None:
                self.line(f"{self.named('pack', packer)}.variable({value}, _add)")
            else:
                self.line(f"{self.named('pack', packer)}.fixed({value}, {field.length}, _add)")
            return
        values, element = self.local(), self.local()
        self.line(f"{values} = {value}")
        check = f"{self.named('length', _checked_length)}({values}, {field.length})"
        if field.length is None:
            self.line(f"_add({self.named('count', _COUNT.pack)}({check}))")
        else:
            self.line(check)
        self.line(f"for {element} in {values}:")
        self._depth += 1
        self.line("pass")
        self._one(field.base, element)
        self.flush()
        self._depth -= 1

    def flush(self) -> None:
        """Write the numbers that wait."""
        if self._run:
            run, self._run = self._run, []
            packer = Struct("<" + "".join(code for code, _ in run)).pack
            self.line(f"_add({self.named('pack', packer)}({', '.join(v for _, v in run)}))")


def _checked_length(values: Any, length: int | None) -> int:
    """Return the number of elements of a list; a text is none, though it has characters."""
    if not isinstance(values, (list, tuple)) or length not in (None, len(values)):
        raise TypeError
    return len(values)


def make_encoder(definition: Definition, shapes: Mapping[str, Shape]) -> Callable[..., None]:
    """Return ``encode(message, add)``, which hands the pieces of a message to ``add``."""
    writer = _EncoderWriter(shapes)
    writer.line("pass")
    writer.message(definition, "_m")
    writer.flush()
    return writer.made("def _function(_m, _add):")


class _DecoderWriter(_Writer):
    """Writes ``_function(_data, _p, _end)``, which gives a message and the position behind it."""

    def __init__(self, shapes: Mapping[str, Shape]) -> None:
        super().__init__(shapes)
        self._offset = 0

    def message(self, definition: Definition, cls: Callable[..., Any]) -> str:
        """Write the reading of all fields; return the expression that is the message."""
        values = [self._field(field) for field in definition.fields]
        return f"{self.named('new', cls)}({', '.join(values)})"

    def finish(self, message: str) -> None:
        """Write the end of the function."""
        self._to_position()
        self.line(f"return {message}, _p")

    def _field(self, field: Field) -> str:
        if not field.is_array:
            return self._one(field.base)
        return self._numbers(field) if field.base in DTYPES else self._list(field)

    def _one(self, base: str) -> str:
        if base in CODES:
            return self._number("?" if base == "bool" else CODES[base])
        if base in TIME_CODES:
            code = TIME_CODES[base]
            cls = self.named("new", self.shapes[base].cls)
            return f"{cls}({self._number(code)}, {self._number(code)})"
        if base == "string":
            return self._string()
        return self._inner(self.shapes[base])

    def _number(self, code: str) -> str:
        name = self.local()
        self._run.append((code, name))
        return name

    def _inner(self, shape: Shape) -> str:
        if self.inlines(shape):
            return self.message(shape.definition, shape.cls)
        self._to_position()
        name = self.local()
        self.line(f"{name}, _p = {self.named('decode', shape.decode)}(_data, _p, _end)")
        return name

    def _string(self) -> str:
        size, begin, text = self._number("I"), self.local(), self.local()
        self._flush()
        self._take(begin, size)
        self.line(f"{text} = str(_data[{begin}:_p], 'utf-8', '{ESCAPE}')")
        return text

    def _take(self, begin: str, size: str) -> None:
        """Let a variable be the present position, and go behind ``size`` bytes."""
        self.line(f"{begin} = {self._position}")
        self.line(f"_p = {begin} + {size}")
        self.line("if _p > _end:")
        self.line(f"    {self.named('short', _too_short)}({begin}, _p, _end)")
        self._offset = 0

    def _numbers(self, field: Field) -> str:
        dtype, name, begin = DTYPES[field.base], self.local(), self.local()
        view = self.named("view", np.frombuffer)
        of_type = self.named("dtype", dtype)
        empty = self.named("empty", EMPTY[field.base])
        size = self._number("I") if field.length is None else str(field.length)
        self._flush()
        self._take(begin, f"{size} * {dtype.itemsize}")
        read = f"{view}(_data, {of_type}, {size}, {begin})"
        self.line(f"{name} = {read} if {size} else {empty}")
        return name

    def _list(self, field: Field) -> str:
        least = least_size(field._replace(is_array=False, length=None), self.shapes)
        size = self._number("I") if field.length is None else str(field.length)
        self._to_position()
        if field.length is None:
            limit = f"(_end - _p) // {least}" if least else str(MAX_EMPTY)
            self.line(f"if {size} > {limit}:")
            self.line(f"    {self.named('many', _too_many)}({size}, _p)")
        values = self.local()
        self.line(f"{values} = []")
        self.line(f"for _ in range({size}):")
        self._depth += 1
        value = self._one(field.base)
        self._to_position()
        self.line(f"{values}.append({value})")
        self._depth -= 1
        return values

    @property
    def _position(self) -> str:
        return f"_p + {self._offset}" if self._offset else "_p"

    def _flush(self) -> None:
        """Write the reading of the numbers that wait."""
        if self._run:
            run, self._run = self._run, []
            numbers = Struct("<" + "".join(code for code, _ in run))
            unpack = self.named("unpack", numbers.unpack_from)
            targets = "".join(f"{name}, " for _, name in run)
            self.line(f"{targets}= {unpack}(_data, {self._position})")
            self._offset += numbers.size

    def _to_position(self) -> None:
        """Read what waits, and let ``_p`` be the position behind it."""
        self._flush()
        if self._offset:
            self.line(f"_p += {self._offset}")
            self._offset = 0


def _too_short(begin: int, wanted: int, end: int) -> None:
    raise ValueError(f"{wanted - begin} bytes at {begin}, there are {max(0, end - begin)}")


def _too_many(size: int, position: int) -> None:
    raise ValueError(f"array of {size} elements at byte {position}")


def make_decoder(
    definition: Definition, cls: Callable[..., Any], shapes: Mapping[str, Shape]
) -> Callable[..., tuple[Any, int]]:
    """Return ``decode(data, position, end)``, which gives a message and the position behind it."""
    writer = _DecoderWriter(shapes)
    writer.finish(writer.message(definition, cls))
    return writer.made("def _function(_data, _p, _end):")
