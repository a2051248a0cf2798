"""Structured Text in reports of coverage.py, where this module is among its ``plugins``.

Programs that run under pytest are measured; their lines and branches go into the data of
coverage.py, from which its reports are made as for Python.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from plcsim.program.structured_text.coverage import MEASURING, exits_of, possible_in
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from plcsim.program.structured_text.coverage import Seen

SUFFIX: Final = ".st"


def coverage_init(registry: Any, _options: dict[str, str]) -> None:
    """Take part in a measurement: coverage.py calls this."""
    base = import_module("coverage").CoveragePlugin
    plugin = type("StructuredText", (base,), {"file_reporter": _reporter})
    registry.add_file_tracer(plugin())
    MEASURING.is_on = MEASURING.is_collected = True


def collect() -> None:
    """Hand over what has run since the last call."""
    if not MEASURING.is_collected:
        return
    current = import_module("coverage").Coverage.current()
    found = {p: seen for p, seen in MEASURING.collect().items() if Path(p).is_file()}  # no helpers
    if current is None or not found:
        return
    data = current.get_data()
    if current.get_option("run:branch"):
        data.add_arcs({path: _arcs(seen) for path, seen in found.items()})
    else:
        data.add_lines({path: seen.lines for path, seen in found.items()})
    name = f"{__name__}.StructuredText"
    data.add_file_tracers(dict.fromkeys(found, name))


def _arcs(seen: Seen) -> set[tuple[int, int]]:
    """Return ways, and one to each line as if the file began there, which says that it has run."""
    return _ways(seen) | {(-1, line) for line in seen.lines}


def _ways(seen: Seen) -> set[tuple[int, int]]:
    """Return the ways that lead to another line, as coverage.py knows no others."""
    return {(line, target) for line, target in seen.ways if line != target}


def _reporter(_plugin: object, filename: str) -> Any:
    base = import_module("coverage").FileReporter
    names = {"source": _source, "lines": _lines, "arcs": _possible_arcs, "exit_counts": _exits}
    return type("StructuredTextReporter", (base,), names)(filename)


def _source(reporter: Any) -> str:
    return Source.read(Path(reporter.filename)).text


def _lines(reporter: Any) -> set[int]:
    seen = possible_in(_source(reporter))
    return set() if seen is None else seen.lines


def _possible_arcs(reporter: Any) -> set[tuple[int, int]]:
    seen = possible_in(_source(reporter))
    return set() if seen is None else _arcs(seen)


def _exits(reporter: Any) -> dict[int, int]:
    seen = possible_in(_source(reporter))
    return {} if seen is None else exits_of(_ways(seen))
