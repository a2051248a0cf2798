"""The I/O image of an Automation Studio project: its channels as tags, its maps as lines.

A channel has the width of the letter in the map, and the type of its variable where that has this
width. What is mapped to no variable that is there is told, and is a channel all the same.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.tag import CHANNELS
from plcsim.project.automation_studio.io_image import IoImage, Line, VariableCopy
from st_types.types.derived import Member, StructType, resolve_alias
from st_types.types.elementary import BOOL, UDINT, UINT, ULINT, USINT, ElementaryType
from st_types.types.paths import find

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.core.controller import Controller
    from plcsim.core.tag import Tag
    from plcsim.program.declarations import Declarations
    from plcsim.project.automation_studio.mapping import Channel, Maps, Pv, PvMapLine
    from st_types.types.elementary import DataType

_WIDTHS: Final[Mapping[str, ElementaryType[bool] | ElementaryType[int]]] = {
    "X": BOOL,
    "B": USINT,
    "W": UINT,
    "D": UDINT,
    "O": ULINT,
}

_NAME = re.compile(r"\w+")
_NO_NAME = re.compile(r"\W")


def names_of(channel: Channel) -> tuple[str, str]:
    """Return the names of module and channel as members of a tag."""
    return _NO_NAME.sub("_", channel.module), _NO_NAME.sub("_", channel.channel)


def channels_type(
    channels: Sequence[Channel], type_of: Callable[[Pv], DataType[object] | None]
) -> StructType[object] | None:
    """Return the type of all channels, a STRUCT for each module; None where there are none.

    Args:
        channels: as the map has them; one that stands on several lines is one.
        type_of: returns the type of a variable, None where there is none.
    """
    modules: dict[str, dict[str, Member]] = {}
    for channel in sorted(channels, key=lambda channel: channel.direction):  # inputs side by side
        module, name = names_of(channel)
        members = modules.setdefault(module, {})
        if name not in members:
            members[name] = Member(name, _type(channel, type_of(channel.pv)))
    if not modules:
        return None
    inside = [
        Member(name, StructType(name, [*members.values()])) for name, members in modules.items()
    ]
    return StructType(CHANNELS, inside)


def _type(channel: Channel, data_type: DataType[object] | None) -> DataType[object]:
    default = _WIDTHS[channel.width]
    found = None if data_type is None else resolve_alias(data_type)
    if isinstance(found, ElementaryType) and found.size == default.size:
        return found
    return default


def variable_type(
    declarations: Declarations, sources: Mapping[str, str], pv: Pv
) -> DataType[object] | None:
    """Return the type of a variable that a map names, None where there is none.

    Args:
        declarations: of the project.
        sources: programs by the names of their tasks, in capitals.
        pv: the variable.
    """
    source = sources.get(pv.task.upper())
    known = source is not None and source in declarations.layout.programs
    scope = declarations.scope_of(source) if source and known else declarations.scope
    name = _NAME.match(pv.path)
    variable = scope.find_variable(name[0]) if name else None
    if name is None or variable is None or variable.data_type is None:
        return None
    try:
        return find(variable.data_type, pv.path[name.end() :].removeprefix("."))[0]
    except KeyError:
        return None


MODULE_OK: Final = "ModuleOk"
"""The channel by which an I/O module says that it is there and works."""


class _Ends(NamedTuple):
    """The ends of the lines of a map, found on a controller, and what is not there."""

    inputs: dict[int, list[Line]]
    outputs: dict[int, list[Line]]
    copies: list[VariableCopy]
    permanent: list[Tag]
    missing: list[str]


def unmapped(controller: Controller, maps: Maps) -> list[str]:
    """Return what the lines of maps name and is not there, with file and line.

    Args:
        controller: with the tag `plcsim.core.tag.CHANNELS`.
        maps: of its configuration.
    """
    return _ends(controller, maps).missing


def connect(controller: Controller, maps: Maps) -> list[str]:
    """Let a controller latch and publish the channels of its maps, and keep permanent variables.

    Args:
        controller: with the tag `plcsim.core.tag.CHANNELS`, not booted yet.
        maps: of its configuration.

    Returns:
        what is mapped and not there, and what is simulated, a line for each.
    """
    ends = _ends(controller, maps)
    if ends.inputs or ends.outputs or ends.copies:
        IoImage(controller, ends.inputs, ends.outputs, ends.copies)
    for tag in ends.permanent:
        controller.retained.add_permanent(tag)
    return [*ends.missing, *_module_states(controller, maps)]


def _ends(controller: Controller, maps: Maps) -> _Ends:
    ends = _Ends({}, {}, [], [], [])
    classes = _Classes(controller)
    for channel in maps.channels:
        _add_channel(controller, classes, channel, ends)
    for copy in maps.copies:
        _add_copy(controller, classes, copy, ends)
    for line in maps.permanent:
        tag = controller.tags.get(line.pv.tag)
        if tag is None:
            ends.missing.append(_missing(line.location, line.pv))
        else:
            ends.permanent.append(tag)
    return ends


def _missing(location: str, pv: Pv) -> str:
    return f"{location}: warning: there is no variable {pv.tag}"


def _module_states(controller: Controller, maps: Maps) -> list[str]:
    """Let modules say at each boot that they are there: programs wait for it; return the note."""
    names = [names_of(each) for each in maps.channels if each.direction == "I"]
    paths = dict.fromkeys(".".join((CHANNELS, *each)) for each in names if each[-1] == MODULE_OK)
    found = [tag for tag in map(controller.tags.get, paths) if tag is not None]
    memory = controller.memory

    def reset() -> None:
        for tag in found:
            memory.write(tag.address, b"\x01")

    if not found:
        return []
    memory.at_boot(reset)
    modules = f"{len(found)} modules" if len(found) > 1 else "1 module"
    return [f"{MODULE_OK} of {modules} is simulated: TRUE"]


def _add_channel(controller: Controller, classes: _Classes, channel: Channel, ends: _Ends) -> None:
    variable = controller.tags.get(channel.pv.tag)
    place = controller.tags.get(".".join((CHANNELS, *names_of(channel))))
    if variable is None or place is None:
        ends.missing.append(f"{_missing(channel.location, channel.pv)} for {channel.name}")
        return
    sizes = variable.data_type.size, place.data_type.size
    size = min(sizes)
    if size < max(sizes):
        text = f"{channel.pv.tag} has {sizes[0]} bytes and {channel.name} {sizes[1]}"
        ends.missing.append(f"{channel.location}: warning: {text}: {size} are copied")
    line = Line(place.address, variable.address, size, channel.is_inverse and size == 1)
    lines = ends.inputs if channel.direction == "I" else ends.outputs
    lines.setdefault(classes.of(channel.pv, variable), []).append(line)


def _add_copy(controller: Controller, classes: _Classes, copy: PvMapLine, ends: _Ends) -> None:
    source = controller.tags.get(copy.source.tag)
    target = controller.tags.get(copy.target.tag)
    if source is None or target is None:
        ends.missing.append(_missing(copy.location, copy.source if source is None else copy.target))
        return
    if source.data_type.size != target.data_type.size:
        text = f"{copy.source.tag} and {copy.target.tag} differ in size, nothing is copied"
        ends.missing.append(f"{copy.location}: warning: {text}")
        return
    from_class, to_class = classes.of(copy.source, source), classes.of(copy.target, target)
    size = source.data_type.size
    ends.copies.append(VariableCopy(source.address, target.address, size, from_class, to_class))


class _Classes:
    """Which task class latches or publishes a variable."""

    def __init__(self, controller: Controller) -> None:
        self._tasks = {t.name.upper(): c.number for c in controller.classes for t in c.tasks}
        self._numbers = [each.number for each in controller.classes]

    def of(self, pv: Pv, tag: Tag) -> int:
        """Return the class that the map names, else that of the task, else the fastest."""
        if pv.task_class in self._numbers:
            return pv.task_class or 0
        task = tag.path.partition(".")[0].upper()
        return self._tasks.get(task, self._numbers[0])
