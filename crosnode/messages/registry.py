"""Message, service and action types by name: definition, md5, full text, codec.

A type is found in the package folders given, then among the common packages that come with
crosnode. Names are ``pkg/Name``. The two halves of a service are message types ``pkg/NameRequest``
and ``pkg/NameResponse``; an action has the seven message types of actionlib.
"""

from __future__ import annotations

import hashlib
import re
from typing import TYPE_CHECKING, Final

from crosnode.errors import DefinitionError, MessageTypeError, UnknownTypeError
from crosnode.messages.codec import Codec
from crosnode.messages.definition import (
    HEADER,
    Definition,
    Field,
    md5_text,
    parse_message,
    split_parts,
    split_type_name,
)
from crosnode.messages.packages import SHARE, DefinitionKind, PackagePath

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from pathlib import Path

    from crosnode.messages.message import Message

_SEPARATOR: Final = "=" * 80
_MAX_NESTING: Final = 64
_HALVES: Final = ("Request", "Response")
_PARTS: Final = ("Goal", "Result", "Feedback")

_ACTION_MESSAGES: Final = {
    "Action": (
        "{name}ActionGoal action_goal\n"
        "{name}ActionResult action_result\n"
        "{name}ActionFeedback action_feedback\n"
    ),
    "ActionGoal": "Header header\nactionlib_msgs/GoalID goal_id\n{name}Goal goal\n",
    "ActionResult": "Header header\nactionlib_msgs/GoalStatus status\n{name}Result result\n",
    "ActionFeedback": "Header header\nactionlib_msgs/GoalStatus status\n{name}Feedback feedback\n",
}
"""The messages that actionlib makes of ``name.action`` beside its three parts."""


class MessageType:
    """A message type.

    Attributes:
        name: ``pkg/Name``.
        md5sum: 32 hexadecimal digits, as genmsg computes them.
        definition: constants, fields and raw text.
        full_text: the raw text with those of all dependencies, the ``message_definition`` of a
            TCPROS header (the layout of ``gendeps --cat``).
    """

    def __init__(self, types: MessageTypes, definition: Definition) -> None:
        self._types = types
        self.definition = definition
        self.name = definition.name
        self.md5sum = _md5(types.md5_text(definition))
        self.full_text = _full_text(types, definition.text, (definition,))

    def __repr__(self) -> str:
        return f"MessageType({self.name!r})"

    @property
    def fields(self) -> tuple[Field, ...]:
        """Fields in order of declaration."""
        return self.definition.fields

    @property
    def constants(self) -> Mapping[str, bool | int | float | str]:
        """Constants by name."""
        return {constant.name: constant.value for constant in self.definition.constants}

    def new(self, **values: object) -> Message:
        """Return a new message: ``values`` for the fields named, defaults for the others.

        Raises:
            DefinitionError: the type cannot be encoded (see ``Codec.add``).
            TypeError: no such field.
        """
        return self._types.message_class(self.name)(**values)

    def encode(self, message: object) -> bytes:
        """Return the message as bytes; see ``Codec.encode``."""
        return self._types.codec_for(self.name).encode(self.name, message)

    def decode(self, data: bytes | bytearray | memoryview) -> Message:
        """Return the message that ``data`` holds; see ``Codec.decode``."""
        return self._types.codec_for(self.name).decode(self.name, data)

    @property
    def messages(self) -> tuple[MessageType, ...]:
        """The message type itself."""
        return (self,)

    def warm(self) -> None:
        """Compile the codec; call it before the first cycle (milliseconds)."""
        self._types.codec_for(self.name).warm(self.name)


class ServiceType:
    """A service type.

    Attributes:
        name: ``pkg/Name``.
        md5sum: 32 hexadecimal digits over both halves.
        text: the raw text.
        full_text: the raw text with those of all dependencies.
        request: message type ``pkg/NameRequest``.
        response: message type ``pkg/NameResponse``.
    """

    def __init__(self, types: MessageTypes, name: str, text: str) -> None:
        self.name = name
        self.text = text
        self.request, self.response = (types.message(name + half) for half in _HALVES)
        halves = (self.request.definition, self.response.definition)
        self.md5sum = _md5("".join(map(types.md5_text, halves)))
        self.full_text = _full_text(types, text, halves)

    def __repr__(self) -> str:
        return f"ServiceType({self.name!r})"

    @property
    def messages(self) -> tuple[MessageType, ...]:
        """Both halves."""
        return self.request, self.response

    def warm(self) -> None:
        """Compile both codecs; call it before the first cycle."""
        self.request.warm()
        self.response.warm()


class ActionType:
    """An action type, as actionlib makes it of ``Name.action``.

    Attributes:
        name: ``pkg/Name``.
        md5sum: of the message ``pkg/NameAction``, which holds all others.
        goal: message type ``pkg/NameGoal``. ``result`` and ``feedback`` likewise.
        action_goal: message type ``pkg/NameActionGoal`` of the topic ``goal``. ``action_result``
            and ``action_feedback`` likewise.
        action: message type ``pkg/NameAction``.
    """

    def __init__(self, types: MessageTypes, name: str) -> None:
        self.name = name
        self.goal, self.result, self.feedback = (types.message(name + part) for part in _PARTS)
        self.action, self.action_goal, self.action_result, self.action_feedback = (
            types.message(name + suffix) for suffix in _ACTION_MESSAGES
        )
        self.md5sum = self.action.md5sum

    def __repr__(self) -> str:
        return f"ActionType({self.name!r})"

    @property
    def messages(self) -> tuple[MessageType, ...]:
        """All seven, those that others contain before them."""
        inner = (self.goal, self.result, self.feedback)
        return (*inner, self.action_goal, self.action_result, self.action_feedback, self.action)

    def warm(self) -> None:
        """Compile all codecs; call it before the first cycle."""
        for message_type in self.messages:
            message_type.warm()


class MessageTypes:
    """All types reachable from a list of package folders.

    Args:
        paths: folders searched before the common packages, first match wins.
    """

    def __init__(self, paths: Iterable[Path] = ()) -> None:
        self._packages = PackagePath([*paths, SHARE])
        self._defined: dict[str, str] = {}
        self._definitions: dict[str, Definition] = {}
        self._checked: set[str] = set()
        self._messages: dict[str, MessageType] = {}
        self._services: dict[str, ServiceType] = {}
        self._actions: dict[str, ActionType] = {}
        self._classes: dict[str, type[Message]] = {}
        self._codec = Codec()

    def message(self, name: str) -> MessageType:
        """Return the message type ``name``.

        Raises:
            UnknownTypeError: no definition was found for it or for a type of one of its fields.
            DefinitionError: a definition is wrong, or contains itself.
        """
        name = "/".join(split_type_name(name))
        if name not in self._messages:
            self._check_nesting(self.definition(name), ())
            self._messages[name] = MessageType(self, self.definition(name))
        return self._messages[name]

    def service(self, name: str) -> ServiceType:
        """Return the service type ``name``; raises as ``message`` does."""
        name = "/".join(split_type_name(name))
        if name not in self._services:
            text = self._packages.read(name, DefinitionKind.SERVICE)
            if text is None:
                raise UnknownTypeError(f"No service type {name}.")
            self._services[name] = ServiceType(self, name, text)
        return self._services[name]

    def action(self, name: str) -> ActionType:
        """Return the action type ``name``; raises as ``message`` does."""
        name = "/".join(split_type_name(name))
        if name not in self._actions:
            if self._packages.read(name, DefinitionKind.ACTION) is None:
                raise UnknownTypeError(f"No action type {name}.")
            self._actions[name] = ActionType(self, name)
        return self._actions[name]

    def find(self, name: str) -> MessageType | ServiceType | ActionType:
        """Return the message, service or action type ``name``, looked for in this order.

        ``pkg/srv/Name`` is a service where a message of the same name is, ``pkg/action/Name`` an
        action. Raises as ``message`` does.
        """
        short = "/".join(split_type_name(name))
        kinds: dict[DefinitionKind, Callable[[str], ServiceType | ActionType]]
        kinds = {DefinitionKind.SERVICE: self.service, DefinitionKind.ACTION: self.action}
        named = [kind for kind in kinds if f"/{kind.value}/" in name]
        if not named and not self._lacks(short):
            return self.message(short)
        for kind in named or kinds:
            if self._packages.read(short, kind) is not None:
                return kinds[kind](short)
        if self._lacks(short):
            raise UnknownTypeError(f"No message, service or action type {short}.")
        return self.message(short)

    def define(self, name: str, text: str) -> MessageType:
        """Add a message type by its text, before any folder; dependencies may follow in the text.

        Args:
            name: ``pkg/Name``.
            text: a definition, or the full text of a TCPROS header or a bag.

        Raises:
            MessageTypeError: the type is known already with another text, or as in ``message``.
        """
        for each, its_text in _split_full_text(name, text):
            known = self._definitions.get(each)
            if known is None:
                self._defined[each] = its_text
            elif known._replace(text=its_text) != parse_message(each, its_text):
                raise MessageTypeError(f"{each} is known already with another definition.")
        return self.message(name)

    def definition(self, name: str) -> Definition:
        """Return the parsed definition of a message type, without its dependencies."""
        if name not in self._definitions:
            text = self._message_text(name)
            if text is None:
                raise UnknownTypeError(f"No message type {name}.")
            definition = parse_message(name, text)
            fields = tuple(map(self._header_array, definition.fields))
            self._definitions[name] = definition._replace(fields=fields)
        return self._definitions[name]

    def add_dependencies(self, definition: Definition, found: dict[str, Definition]) -> None:
        """Add the definitions of all message fields to ``found``, depth first, each once."""
        for field in definition.fields:
            if not field.is_builtin:
                inner = self.definition(field.base)
                if inner.name not in found:
                    found[inner.name] = inner
                    self.add_dependencies(inner, found)

    def md5_text(self, definition: Definition) -> str:
        """Return the text whose md5 identifies the message type."""
        return md5_text(definition, lambda name: self.message(name).md5sum)

    def message_class(self, name: str) -> type[Message]:
        """Return the class of a message type, made at first use."""
        if name not in self._classes:
            definition = self.definition(name)
            for field in definition.fields:
                if not field.is_builtin:
                    self.message_class(field.base)
            self._classes[name] = self._codec.add(definition)
        return self._classes[name]

    def codec_for(self, name: str) -> Codec:
        """Return the codec, which knows the type from here on."""
        if name not in self._classes:
            self.message_class(name)
        return self._codec

    def _header_array(self, field: Field) -> Field:
        """Let ``Header[]`` mean std_msgs/Header where the package has no Header of its own."""
        is_array = field.declared.startswith("Header[")
        return field._replace(base=HEADER) if is_array and self._lacks(field.base) else field

    def _lacks(self, name: str) -> bool:
        return self._message_text(name) is None

    def _message_text(self, name: str) -> str | None:
        if name in self._defined:
            return self._defined[name]
        text = self._packages.read(name, DefinitionKind.MESSAGE)
        if text is None:
            text = self._action_text(name)
        return self._service_half(name) if text is None else text

    def _service_half(self, name: str) -> str | None:
        for index, half in enumerate(_HALVES):
            if name.endswith(half) and not name.endswith("/" + half):
                text = self._packages.read(name.removesuffix(half), DefinitionKind.SERVICE)
                return None if text is None else split_parts(name, text, 2)[index]
        return None

    def _action_text(self, name: str) -> str | None:
        for suffix in (*_ACTION_MESSAGES, *_PARTS):
            if name.endswith(suffix) and not name.endswith("/" + suffix):
                action = name.removesuffix(suffix)
                text = self._packages.read(action, DefinitionKind.ACTION)
                if text is not None:
                    return _part_of_action(action, suffix, text)
        return None

    def _check_nesting(self, definition: Definition, outer: tuple[str, ...]) -> None:
        if definition.name in outer or len(outer) > _MAX_NESTING:
            raise DefinitionError(f"{definition.name} contains itself.")
        for field in definition.fields:
            if not field.is_builtin and field.base not in self._checked:
                self._check_nesting(self._known(definition, field), (*outer, definition.name))
        self._checked.add(definition.name)

    def _known(self, definition: Definition, field: Field) -> Definition:
        try:
            return self.definition(field.base)
        except UnknownTypeError as error:
            raise UnknownTypeError(f"{definition.name}.{field.name}: {error}") from error


def _part_of_action(action: str, suffix: str, text: str) -> str:
    parts = split_parts(action, text, 3)
    if suffix in _PARTS:
        return parts[_PARTS.index(suffix)]
    return _ACTION_MESSAGES[suffix].format(name=action.partition("/")[2])


def _split_full_text(name: str, text: str) -> list[tuple[str, str]]:
    """Cut a full text into names and raw texts; the newline before a separator is not text."""
    head, *rest = re.split(rf"\n{_SEPARATOR}\nMSG:[ \t]+(\S+)[ \t]*\n", text.replace("\r\n", "\n"))
    return [(name, head), *zip(rest[::2], rest[1::2], strict=True)]


def _full_text(types: MessageTypes, text: str, definitions: Iterable[Definition]) -> str:
    found: dict[str, Definition] = {}
    for definition in definitions:
        types.add_dependencies(definition, found)
    blocks = [f"{_SEPARATOR}\nMSG: {each.name}\n{each.text}" for each in found.values()]
    return "\n".join([text, *blocks])


def _md5(text: str) -> str:
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()
