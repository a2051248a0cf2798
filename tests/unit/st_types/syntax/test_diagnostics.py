import pytest

from st_types.errors import SourceError
from st_types.syntax.diagnostics import (
    EXCERPT_WIDTH,
    MAX_DIAGNOSTICS,
    DiagnosticLog,
    DiagnosticSeverity,
    excerpt_of,
    render_all,
)
from st_types.syntax.source import Source


def test_an_error_shows_its_line_and_a_caret() -> None:
    log = DiagnosticLog(Source("Types.typ", "TYPE\n\tSpeed REAL;\nEND_TYPE"))
    log.error(12, "expected ':' after the name Speed", "write Speed : REAL;")
    assert log.records[0].render().splitlines() == [
        "Types.typ:2:8: error: expected ':' after the name Speed",
        "     2 |  Speed REAL;",
        "       |        ^",
        "       hint: write Speed : REAL;",
    ]


def test_warnings_do_not_raise_and_errors_do() -> None:
    log = DiagnosticLog(Source("a.typ", "x"))
    log.warning(0, "odd")
    log.raise_errors()
    log.error(0, "wrong")
    with pytest.raises(SourceError, match=r"a\.typ:1:1: error: wrong") as caught:
        log.raise_errors()
    assert [d.severity for d in caught.value.diagnostics] == [
        DiagnosticSeverity.WARNING,
        DiagnosticSeverity.ERROR,
    ]


def test_warnings_leave_room_for_errors_and_the_rest_is_counted() -> None:
    log = DiagnosticLog(Source("a.typ", "x"))
    for _ in range(MAX_DIAGNOSTICS + 5):
        log.warning(0, "odd")
    for _ in range(MAX_DIAGNOSTICS + 2):
        log.error(0, "wrong")
    assert len(log.records) == 2 * MAX_DIAGNOSTICS
    assert (log.warning_count, log.error_count, log.omitted) == (25, 22, 7)
    assert render_all(log.records, log.omitted).endswith("... and 7 more that are not shown")


@pytest.mark.parametrize("column", [1, 60, 5000, 9_999, 10_000])
def test_a_long_line_is_cut_around_the_column(column: int) -> None:
    line = "".join(chr(33 + i % 90) for i in range(10_000))
    excerpt, caret = excerpt_of(line, column)
    assert len(excerpt) <= EXCERPT_WIDTH + 6
    assert excerpt[caret] == line[column - 1]


def test_unprintable_characters_do_not_reach_the_terminal() -> None:
    assert excerpt_of("a\x1b[2J\tb\u202e", 1) == ("a?[2J b?", 0)
