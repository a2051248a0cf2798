import pytest

from plcsim.core.errors import ConfigurationError, Fault, Findings, ProgramError


def test_an_error_tells_all_its_findings() -> None:
    error = ConfigurationError("a is wrong", "b is wrong")
    assert error.findings == ("a is wrong", "b is wrong")
    assert str(error) == "a is wrong\nb is wrong"


def test_findings_are_gathered_each_once_and_told_in_one_go() -> None:
    findings = Findings()
    findings.check()
    for texts in (("a", "b"), ("b", "c")):
        with findings.gathered():
            raise ConfigurationError(*texts)
    findings.add(ConfigurationError("d"))
    assert findings
    with pytest.raises(ConfigurationError) as raised:
        findings.check()
    assert raised.value.findings == ("a", "b", "c", "d")


def test_what_is_no_finding_goes_on_up() -> None:
    findings = Findings()
    with pytest.raises(ValueError, match="other"), findings.gathered():
        raise ValueError("other")
    assert not findings


def test_what_a_program_raised_is_told_with_its_line() -> None:
    error = ProgramError("p", "CYCLIC", Fault("main.py:3", "division by zero", ("main.py:3 in f",)))
    assert str(error) == "p CYCLIC: division by zero (main.py:3)"
    assert (error.location, error.reason) == ("main.py:3", "division by zero")
    assert error.calls == ("main.py:3 in f",)
    assert str(ProgramError("p", "", Fault("", "it hung"))) == "p: it hung"
