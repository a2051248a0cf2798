from plcsim.program.structured_text.check.findings import FileFindings
from st_types.syntax.diagnostics import MAX_DIAGNOSTICS, DiagnosticLog
from st_types.syntax.lexer import Tokens
from st_types.syntax.source import Source


def test_near_names_are_looked_for_as_long_as_errors_are_recorded() -> None:
    source = Source("a.st", "a")
    log = DiagnosticLog(source)
    findings = FileFindings(Tokens(source), log)
    assert findings.near("sped", ["speed"]) == "; did you mean speed?"
    for _ in range(MAX_DIAGNOSTICS):
        log.error(0, "wrong")
    assert not findings.near("sped", ["speed"])
