"""What is wrong in the dependencies that lists of libraries (``*.lby``) name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.project.automation_studio.finding import Finding

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from plcsim.project.automation_studio.logical_view import Dependency, SourceFolder


def wrong_dependencies(libraries: Iterable[SourceFolder]) -> list[Finding]:
    """Return libraries that are needed and not there, and those that need each other in a circle.

    Both are warnings: Automation Studio builds no such project, and what such a library really
    uses is found or missed when it is compiled.
    """
    known = {library.name.upper(): library for library in libraries}
    findings = [
        _finding(library, each, f"library {each.name} is needed and not there")
        for library in known.values()
        for each in library.dependencies
        if each.name.upper() not in known
    ]
    told: set[str] = set()
    for name, library in known.items():
        way = [] if name in told else _circle(known, name)
        if way:
            told.update(each.upper() for each in way)
            message = f"libraries need each other in a circle: {' -> '.join(way)}"
            first = next(
                each for each in library.dependencies if each.name.upper() == way[1].upper()
            )
            findings.append(_finding(library, first, message))
    return findings


def _circle(known: Mapping[str, SourceFolder], start: str) -> list[str]:
    """Return the shortest way from a library back to it, [] where there is none."""
    ways = [[start]]
    seen: set[str] = set()
    for way in ways:  # grows meanwhile
        for name in _needed(known, way[-1]):
            if name == start:
                return [known[each].name for each in (*way, start)]
            if name not in seen:
                seen.add(name)
                ways.append([*way, name])
    return []


def _needed(known: Mapping[str, SourceFolder], name: str) -> Iterator[str]:
    names = (each.name.upper() for each in known[name].dependencies)
    return (each for each in names if each in known)


def _finding(library: SourceFolder, dependency: Dependency, message: str) -> Finding:
    return Finding(library.list_file or library.folder, dependency.line, message, dependency.name)
