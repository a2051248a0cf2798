"""How the plain value of a tag becomes a message, and a message the value of a tag.

A STRUCT goes with a message member by field, by name and at every level; fields without a member
have their defaults, members without a field keep their values. What ``plcsim types from-ros`` makes
of a message fits it: ``x_length`` beside an ARRAY ``x`` says how many elements are valid, and a
STRUCT of ``sec`` and ``nsec`` is a time. TIME goes with duration, DATE_AND_TIME with time, and an
integer with either as nanoseconds. A STRING is Latin-1 and a ROS string UTF-8; each is converted
to the other, characters that Latin-1 has not to ``?``, and a ROS string that is not UTF-8 is put
into a STRING byte for byte.

What can never fit is a ConfigurationError before the first cycle; a value that does not fit is left
to the encoder of its target.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

from crosnode.messages import Duration, Time
from crosnode.messages.message import attribute_name
from crosnode.messages.text import is_utf8, to_latin1
from plcsim.core.errors import ConfigurationError
from st_types.types.derived import ArrayType, StringType, StructType, WStringType, resolve_alias
from st_types.types.elementary import DATE, DATE_AND_TIME, TIME, TIME_OF_DAY, ElementaryType

if TYPE_CHECKING:
    from collections import Counter
    from collections.abc import Callable

    from crosnode.messages import MessageType, MessageTypes
    from crosnode.messages.definition import Definition, Field
    from st_types.types.elementary import DataType

Cut: TypeAlias = "Callable[[], None]"

Plain: TypeAlias = Any
"""The plain value of a tag (`st_types.types.values.decode`)."""

NS_PER_MS: Final = 1_000_000
NS_PER_S: Final = 1_000_000_000

_UNITS_NS: Final[dict[DataType[Any], int]] = {
    TIME: NS_PER_MS,
    TIME_OF_DAY: NS_PER_MS,
    DATE: NS_PER_S,
    DATE_AND_TIME: NS_PER_S,
}
_TIMES: Final[dict[str, type[Time] | type[Duration]]] = {"time": Time, "duration": Duration}
_SECONDS: Final = (("sec", "nsec"), ("secs", "nsecs"))


class Conversion(NamedTuple):
    """Both ways between the value of a tag and that of a field.

    Attributes:
        to_field: gives the value of the field.
        to_tag: gives the plain value of the tag, from that of the field and the one before.
    """

    to_field: Callable[[Plain], Any]
    to_tag: Callable[[Any, Plain], Plain]


class ConversionContext(NamedTuple):
    """What conversions need beside the two types.

    Attributes:
        types: knows the types of the fields.
        cuts: counts lists and texts that were longer than what took them.
    """

    types: MessageTypes
    cuts: Counter[str]


def tag_conversion(
    types: ConversionContext, message_type: MessageType, data_type: DataType[Any], path: str
) -> Conversion:
    """Return the conversion between a tag and messages.

    Args:
        types: knows the types of the fields, and counts what is cut.
        message_type: of the messages.
        data_type: of the tag.
        path: of the tag, for errors.

    Raises:
        ConfigurationError: the tag is no STRUCT and the message has other than one field, or one
            of the pairs of member and field can never fit.
    """
    data_type = resolve_alias(data_type)
    fields = message_type.fields
    if isinstance(data_type, StructType) and not _is_one_value(data_type, fields):
        return _structure(types, message_type.definition, data_type, path)
    if len(fields) != 1:
        raise ConfigurationError(
            f"tag {path} is one value, {message_type.name} has {len(fields)} fields"
        )
    (field,) = fields
    inner = _field(types, field, data_type, path)
    attribute, new = attribute_name(field.name), types.types.message_class(message_type.name)
    return Conversion(
        lambda value: new(**{attribute: inner.to_field(value)}),
        lambda message, before: inner.to_tag(getattr(message, attribute), before),
    )


def _is_one_value(struct: StructType[Any], fields: tuple[Field, ...]) -> bool:
    """Return whether the whole STRUCT goes into the only field, such as that of std_msgs/Time."""
    return len(fields) == 1 and fields[0].name not in {member.name for member in struct.members}


def _structure(
    types: ConversionContext, definition: Definition, struct: StructType[Any], path: str
) -> Conversion:
    fields = {field.name: field for field in definition.fields}
    parts = {
        member.name: _member(types, fields[member.name], struct, member.data_type, path)
        for member in struct.members
        if member.name in fields
    }
    if not parts:
        raise ConfigurationError(
            f"no member of {path} is a field of {definition.name}: {', '.join(fields)}"
        )
    new = types.types.message_class(definition.name)
    return Conversion(
        lambda values: new(
            **{attribute_name(name): part.to_field(values) for name, part in parts.items()}
        ),
        lambda message, before: _merged(message, before, parts),
    )


def _merged(message: Any, before: Plain, parts: dict[str, Conversion]) -> Plain:
    result = dict(before)
    for name, part in parts.items():
        result |= part.to_tag(getattr(message, attribute_name(name)), before)
    return result


def _member(
    types: ConversionContext,
    field: Field,
    struct: StructType[Any],
    data_type: DataType[Any],
    path: str,
) -> Conversion:
    """Return the conversion of one member, from and to the dict of all."""
    name, length = field.name, f"{field.name}_length"
    inner = _field(types, field, resolve_alias(data_type), f"{path}.{name}")
    names = {member.name for member in struct.members}
    if not field.is_array or field.length is not None or length not in names:
        return Conversion(
            lambda values: inner.to_field(values[name]),
            lambda value, before: {name: inner.to_tag(value, before[name])},
        )
    return Conversion(
        lambda values: inner.to_field(values[name][: max(0, values[length])]),
        lambda value, before: {
            name: inner.to_tag(value, before[name]),
            length: min(len(value), len(before[name])),
        },
    )


def _field(
    types: ConversionContext, field: Field, data_type: DataType[Any], path: str
) -> Conversion:
    if field.is_array != isinstance(data_type, ArrayType):
        raise _misfit(path, data_type, field.declared)
    if not isinstance(data_type, ArrayType):
        return _element(types, field, data_type, path)
    if field.length not in (None, data_type.count):
        raise _misfit(path, data_type, field.declared)
    inner = _element(types, field, resolve_alias(data_type.element), f"{path}[]")
    cut = partial(_count, types.cuts, path)
    return Conversion(
        lambda values: [inner.to_field(value) for value in values],
        lambda found, before: _filled_up(found, before, inner, cut),
    )


def _filled_up(found: Any, before: Plain, inner: Conversion, cut: Cut) -> Plain:
    """Return the elements as an ARRAY takes them: a long list is cut, a short one filled up."""
    if len(found) > len(before):
        cut()
    plain = [inner.to_tag(each, old) for each, old in zip(found, before, strict=False)]
    return [*plain, *before[len(plain) :]]


def _element(
    types: ConversionContext, field: Field, data_type: DataType[Any], path: str
) -> Conversion:
    if field.base in _TIMES:
        return _time(field, data_type, path)
    if not field.is_builtin:
        if isinstance(data_type, StructType):
            return _structure(types, types.types.definition(field.base), data_type, path)
    elif field.base == "string":
        if isinstance(data_type, (StringType, WStringType)):
            cut = partial(_count, types.cuts, path)
            is_wide = isinstance(data_type, WStringType)
            text = partial(_wide_text if is_wide else _text, data_type.length, cut)
            return Conversion(_as_it_is, lambda value, _: text(value))
    elif not isinstance(data_type, (StringType, WStringType, StructType, ArrayType)):
        return Conversion(_as_it_is, lambda value, _: _number(value))
    raise _misfit(path, data_type, field.declared)


def _as_it_is(value: Plain) -> Plain:
    return value


def _text(length: int, cut: Cut, value: str) -> str:
    """Return a text as a STRING takes it; the tag cuts what is longer.

    Characters that Latin-1 has not become ``?``, which counts as cut.
    """
    text = to_latin1(value)
    if len(text) > length or (text != value and is_utf8(value)):
        cut()
    return text


def _wide_text(length: int, cut: Cut, value: str) -> str:
    """Return a text as a WSTRING takes it; the tag cuts what is longer."""
    text = value if is_utf8(value) else to_latin1(value)
    if len(text) > length:
        cut()
    return text


def _count(cuts: Counter[str], path: str) -> None:
    cuts[path] += 1


def _number(value: Any) -> Plain:
    return value.item() if hasattr(value, "item") else value  # numpy's, of an array


def _time(field: Field, data_type: DataType[Any], path: str) -> Conversion:
    cls = _TIMES[field.base]
    if isinstance(data_type, StructType):
        return _seconds(cls, data_type, _misfit(path, data_type, field.declared))
    if not isinstance(data_type, ElementaryType) or not data_type.is_integer:
        raise _misfit(path, data_type, field.declared)
    unit_ns = _UNITS_NS.get(data_type, 1)
    return Conversion(
        lambda value: cls.from_ns(value * unit_ns), lambda value, _: value.to_ns() // unit_ns
    )


def _seconds(
    cls: type[Time | Duration], struct: StructType[Any], misfit: ConfigurationError
) -> Conversion:
    names = {member.name for member in struct.members}
    found = [pair for pair in _SECONDS if names.issuperset(pair)]
    if not found:
        raise misfit
    secs, nsecs = found[0]
    return Conversion(
        lambda values: cls(values[secs], values[nsecs]),
        lambda value, before: {**before, secs: value.secs, nsecs: value.nsecs},
    )


def _misfit(path: str, data_type: DataType[Any], declared: str) -> ConfigurationError:
    return ConfigurationError(f"tag {path} is {data_type}, which does not go with {declared}")
