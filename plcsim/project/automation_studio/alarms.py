"""Alarms and their reactions, as the configuration files of mapp AlarmX have them.

Automation Studio 4 has both in one file (``.mpalarmxcore``), Automation Studio 6 the alarms in
lists (``.mpalarmxlist``) that a core names. A property that has its default is left out of a file.
"""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING, Final

from plcsim.library.document import DocumentError, XmlElement, read_document
from plcsim.library.mapp.configuration import (
    Acknowledgement,
    AlarmBehavior,
    AlarmConfiguration,
    AlarmCoreConfiguration,
    AlarmMapping,
    MappConfiguration,
    Monitoring,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from pathlib import Path

CORE: Final = ".mpalarmxcore"
LIST: Final = ".mpalarmxlist"

ALARMS: Final = "mapp.AlarmX.Core.Configuration"
LISTS: Final = "mapp.AlarmX.List"
MAPPINGS: Final = "mapp.AlarmX.Core"

_EDGE: Final = "EdgeAlarm"
_NS_PER_SECOND: Final = 1_000_000_000


def read_alarms(files: Iterable[Path]) -> MappConfiguration:
    """Read the cores of alarms in configuration files of mapp.

    What cannot be read is left out: `plcsim.project.automation_studio.mapp` tells of it.
    """
    cores: dict[str, XmlElement] = {}
    lists: dict[str, XmlElement] = {}
    for file in dict.fromkeys(files):
        kind = {CORE: cores, LIST: lists}.get(file.suffix.lower())
        if kind is not None:
            with suppress(DocumentError):
                for element in read_document(file).all("Element"):
                    kind.setdefault(element.get("ID").strip(), element)
    return MappConfiguration({name: _core(element, lists) for name, element in cores.items()})


def _core(element: XmlElement, lists: Mapping[str, XmlElement]) -> AlarmCoreConfiguration:
    named = [
        _property(entry, "List")
        for group in _groups(element, LISTS)
        for entry in group.all("Group")
    ]
    places = [element, *(lists[name] for name in named if name in lists)]
    groups = (group for place in places for group in _groups(place, ALARMS))
    found = (_alarm(entry) for group in groups for entry in group.children if entry.tag == "Group")
    mappings = (
        mapping
        for group in _groups(element, MAPPINGS)
        for entry in group.all("Group")
        for mapping in _mappings(entry)
    )
    return AlarmCoreConfiguration({each.name: each for each in found if each}, tuple(mappings))


def _groups(element: XmlElement, name: str) -> Iterator[XmlElement]:
    """Yield the groups of a name."""
    return (each for each in element.all("Group") if each.get("ID") == name)


def _property(element: XmlElement, name: str, default: str = "") -> str:
    """Return a property that stands in an element itself."""
    for each in element.children:
        if each.tag == "Property" and each.get("ID") == name:
            return each.get("Value", default).strip()
    return default


def _alarm(entry: XmlElement) -> AlarmConfiguration | None:
    name = _property(entry, "Name")
    if not name or _is_true(_property(entry, "Disable")):
        return None
    behavior = _selector(entry, "Behavior")
    return AlarmConfiguration(
        name,
        _property(entry, "Message"),
        _whole(_property(entry, "Code"), 0),
        _whole(_property(entry, "Severity"), 1),
        _behavior(behavior),
        None if behavior is None else _monitoring(behavior),
    )


def _selector(element: XmlElement, name: str) -> XmlElement | None:
    found = (each for each in element.children if each.tag == "Selector" and each.get("ID") == name)
    return next(found, None)


def _behavior(selector: XmlElement | None) -> AlarmBehavior:
    if selector is None:
        return AlarmBehavior()
    is_edge = selector.get("Value", _EDGE) == _EDGE

    def flag(*names: str, default: bool) -> bool:
        given = next(filter(None, (_property(selector, name) for name in names)), "")
        return _is_true(given) if given else default

    required = _whole(_property(selector, "Acknowledge"), Acknowledgement.REQUIRED)
    return AlarmBehavior(
        flag("AutoReset", default=is_edge),
        Acknowledgement(min(max(required, 0), Acknowledgement.RESETTABLE)),
        flag("MultipleInstances", default=False),
        flag("ReactionUntilAcknowledged", "ReactionWhilePending", default=True),
    )


def _monitoring(selector: XmlElement) -> Monitoring | None:
    """Return what an alarm of a variable looks at; rates of change are not looked at."""
    group = next(_groups(selector, "Monitoring"), None)
    if group is None or "RateOfChange" in selector.get("Value"):
        return None
    variable = _property(group, "MonitoredPV")
    if not variable:
        return None
    triggers: tuple[float, ...] = ()
    if selector.get("Value") == "DiscreteValueMonitoring":
        values = (p for g in _groups(group, "TriggerValues") for p in g.all("Property"))
        triggers = tuple(_number(each.get("Value")) for each in values) or (1.0,)
    settings = _selector(group, "Settings")
    delay = 0.0 if settings is None else _number(_property(settings, "Delay", "0"))
    return Monitoring(
        variable,
        triggers,
        _property(group, "SetpointPV"),
        _limit(group, "Low"),
        _limit(group, "High"),
        round(max(delay, 0.0) * _NS_PER_SECOND),
    )


def _limit(group: XmlElement, side: str) -> str:
    """Return a limit: a number, or the name of a variable."""
    selector = _selector(group, f"{side}LimitEnable")
    if selector is None:
        return ""
    return _property(selector, "Limit") or _property(selector, "LimitPV")


def _mappings(entry: XmlElement) -> Iterator[AlarmMapping]:
    """Yield the reactions in one entry of a mapping: to an alarm, to severities, or to all."""
    keys = ("Alarm", "AlarmName", "Severity")
    text = next(filter(None, (_property(entry, key) for key in keys)), "")
    is_severity = text.startswith("[") or not _property(entry, "Alarm") + _property(
        entry, "AlarmName"
    )
    severities = tuple(_severities(text)) if is_severity else ()
    if is_severity and text.strip("[] ") and not severities:
        return
    for selector in entry.children:
        action = selector.get("Value")
        name = _property(selector, "Name")
        if selector.tag == "Selector" and action in ("Reaction", "EscalateReaction") and name:
            alarm = "" if is_severity else text
            yield AlarmMapping(name, alarm, severities, action == "EscalateReaction")


def _severities(text: str) -> Iterator[range]:
    """Yield the ranges in ``[1-9]``, ``1,5``, ``20``."""
    for part in text.strip("[] ").split(","):
        first, _, last = part.partition("-")
        with suppress(ValueError):
            yield range(int(first), int(last or first) + 1)


def _is_true(text: str) -> bool:
    return text.strip().upper() in ("TRUE", "1")


def _whole(text: str, default: int) -> int:
    with suppress(ValueError):
        return int(text)
    return default


def _number(text: str) -> float:
    """Return a number; TRUE is 1, what is none is 0."""
    if _is_true(text):
        return 1.0
    with suppress(ValueError):
        return float(text)
    return 0.0
