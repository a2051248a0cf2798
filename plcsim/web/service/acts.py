"""What the pages and scripts may ask for: one table of acts, each with the role that it needs."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.access import Role
from plcsim.core.control import Action
from plcsim.core.errors import PlcError, TagError
from plcsim.shared_image import Control, ForceCommand, Release, StoreCommand, Write
from plcsim.web.service.door import RefusedError
from st_types.errors import ValueRangeError
from st_types.resolve.value_text import value_from
from st_types.types.values import decode, encode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    from plcsim.core.tag import Tag
    from plcsim.web.service.door import Caller
    from plcsim.web.service.hub import Hub

LONGEST_VALUE: Final = 10_000
MOST_READ: Final = 2000

Arguments = Mapping[str, Any]


class Act(NamedTuple):
    """One act.

    Attributes:
        role: who may.
        do: carries it out and returns what JSON can hold.
    """

    role: Role
    do: Callable[[Hub, Caller, Arguments], Awaitable[object]]


async def perform(hub: Hub, caller: Caller, name: str, arguments: Arguments) -> object:
    """Carry out an act, to its end and its line in the audit log even where the caller goes.

    Raises:
        PlcError: it is refused, there is no such act, or its arguments are wrong.
    """
    act = ACTS.get(name)
    if act is None:
        raise PlcError(f"there is no act {name[:40]!r}")
    if not caller.user.role.includes(act.role):
        raise RefusedError(
            f"{name}: the role {caller.user.role.value} may not; {act.role.value} may"
        )
    doing = asyncio.ensure_future(act.do(hub, caller, arguments))
    hub.acting.add(doing)
    doing.add_done_callback(hub.acting.discard)
    return await asyncio.shield(doing)


def text_of(arguments: Arguments, key: str, longest: int = 1000) -> str:
    """Return an argument that is a text.

    Raises:
        PlcError: it is not, or it is too long.
    """
    value = arguments.get(key)
    if not isinstance(value, str) or len(value) > longest:
        raise PlcError(f"{key!r} must be a text of at most {longest} characters")
    return value


def whole_of(arguments: Arguments, key: str, default: int, most: int) -> int:
    """Return an argument that is a whole number from 0.

    Raises:
        PlcError: it is not.
    """
    value = arguments.get(key, default)
    if type(value) is not int or not 0 <= value <= most:
        raise PlcError(f"{key!r} must be a whole number from 0 to {most}")
    return value


def texts_of(arguments: Arguments, key: str, most: int) -> list[str]:
    """Return an argument that is a list of texts.

    Raises:
        PlcError: it is not, or it is too long.
    """
    value = arguments.get(key)
    if isinstance(value, list) and len(value) <= most and all(isinstance(v, str) for v in value):
        return value
    raise PlcError(f"{key!r} must be a list of at most {most} texts")


def _note(hub: Hub, caller: Caller, act: str, **more: object) -> None:
    """Write a line of the audit log."""
    hub.audit.write(
        {
            "time": datetime.now(UTC).isoformat(timespec="microseconds"),
            "who": caller.user.name,
            "role": caller.user.role.value,
            "peer": caller.peer,
            "act": act,
            **more,
        }
    )


def _tag_and_data(hub: Hub, arguments: Arguments) -> tuple[Tag, bytes]:
    tag = hub.image.directory.find(text_of(arguments, "tag"))
    if tag.is_constant:
        raise TagError(f"{tag.path} is CONSTANT")
    try:
        value = value_from(tag.data_type, text_of(arguments, "value", LONGEST_VALUE))
        return tag, encode(tag.data_type, value)
    except ValueRangeError as err:
        raise TagError(f"{tag.path}: {err}") from None


def _shown(tag: Tag, data: bytes) -> str:
    return value_text(tag.data_type, decode(tag.data_type, data))


async def _write(hub: Hub, caller: Caller, arguments: Arguments) -> object:
    tag, data = _tag_and_data(hub, arguments)
    command = Write((StoreCommand(tag.address, data),))
    answer = await hub.commander.ask(command, f"write {tag.path}")
    before = data
    if isinstance(answer.before, Write) and isinstance(answer.before.operations[0], StoreCommand):
        before = answer.before.operations[0].data
    changed = {"tag": tag.path, "before": _shown(tag, before), "value": _shown(tag, data)}
    _note(hub, caller, "write", **changed)
    return changed


async def _force(hub: Hub, caller: Caller, arguments: Arguments) -> object:
    tag, data = _tag_and_data(hub, arguments)
    await hub.commander.ask(ForceCommand(tag.path, data, caller.user.name), f"force {tag.path}")
    changed = {"tag": tag.path, "value": _shown(tag, data)}
    _note(hub, caller, "force", **changed)
    return changed


async def _release(hub: Hub, caller: Caller, arguments: Arguments) -> object:
    path = text_of(arguments, "tag")
    if path:
        path = hub.image.directory.find(path).path
    await hub.commander.ask(Release(path, caller.user.name), f"release {path or 'all'}")
    _note(hub, caller, "release", tag=path or "all")
    return {"tag": path}


async def _read(hub: Hub, _caller: Caller, arguments: Arguments) -> object:
    """Return the values of tags, once; for scripts."""
    paths = texts_of(arguments, "tags", MOST_READ)
    watched = hub.values.watch([hub.image.directory.find(path) for path in paths])
    try:
        hub.values.refresh()
        return {"snapshot": hub.values.snapshot, "values": [one.value for one in watched]}
    finally:
        hub.values.leave(watched)


async def _children(hub: Hub, _caller: Caller, arguments: Arguments) -> object:
    path = text_of(arguments, "path")
    if not path:
        roots = hub.variables.roots()
        return {"children": roots, "count": len(roots)}
    first = whole_of(arguments, "first", 0, 1 << 31)
    if "^" in path:
        return hub.variables.inside(await hub.follower.find(path), first)
    return hub.variables.children(path, first)


async def _search(hub: Hub, _caller: Caller, arguments: Arguments) -> object:
    return hub.variables.search(text_of(arguments, "text", 200))


async def _describe(hub: Hub, _caller: Caller, arguments: Arguments) -> object:
    """Return what is known of tags; None for those that are not there."""
    found: list[dict[str, Any] | None] = []
    for path in texts_of(arguments, "tags", MOST_READ):
        try:
            found.append(hub.variables.describe(await hub.follower.find(path)))
        except TagError:
            found.append(None)
    return found


async def _facts(hub: Hub, _caller: Caller, _arguments: Arguments) -> object:
    return hub.facts()


async def _status(hub: Hub, _caller: Caller, _arguments: Arguments) -> object:
    return {**hub.status(), "forces": hub.forces()}


async def _logbook(hub: Hub, _caller: Caller, _arguments: Arguments) -> object:
    return [entry for _, entry in hub.entries]


async def _sources(hub: Hub, _caller: Caller, _arguments: Arguments) -> object:
    return await asyncio.to_thread(hub.sources.programs)


async def _source(hub: Hub, _caller: Caller, arguments: Arguments) -> object:
    program, file = text_of(arguments, "program"), text_of(arguments, "file")
    return await asyncio.to_thread(hub.sources.read, program, file)


def _control(action: Action) -> Callable[[Hub, Caller, Arguments], Awaitable[object]]:
    async def do(hub: Hub, caller: Caller, arguments: Arguments) -> object:
        name = action.name.lower()
        argument = whole_of(arguments, "argument", 0, 1 << 40)
        await hub.commander.ask(Control(action, argument, caller.user.name), name)
        _note(hub, caller, name, **({"argument": argument} if argument else {}))
        return {}

    return do


ACTS: Final[Mapping[str, Act]] = {
    "facts": Act(Role.LOOK, _facts),
    "status": Act(Role.LOOK, _status),
    "read": Act(Role.LOOK, _read),
    "children": Act(Role.LOOK, _children),
    "search": Act(Role.LOOK, _search),
    "describe": Act(Role.LOOK, _describe),
    "logbook": Act(Role.LOOK, _logbook),
    "sources": Act(Role.LOOK, _sources),
    "source": Act(Role.LOOK, _source),
    "write": Act(Role.OPERATE, _write),
    "pause": Act(Role.OPERATE, _control(Action.PAUSE)),
    "continue": Act(Role.OPERATE, _control(Action.CONTINUE)),
    "stop": Act(Role.OPERATE, _control(Action.STOP)),
    "warm_restart": Act(Role.OPERATE, _control(Action.WARM_RESTART)),
    "cold_restart": Act(Role.ENGINEER, _control(Action.COLD_RESTART)),
    "cycles": Act(Role.ENGINEER, _control(Action.CYCLES)),
    "speed": Act(Role.ENGINEER, _control(Action.SPEED)),
    "force": Act(Role.ENGINEER, _force),
    "release": Act(Role.ENGINEER, _release),
}
"""What can be asked for, over the WebSocket as ``do`` and as ``POST /api/NAME``."""
