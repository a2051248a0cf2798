"""Which lines and branches of compiled programs have run."""

from pathlib import Path

import pytest

from plcsim.program.structured_text import coverage

MAIN = """\
PROGRAM _CYCLIC
n := n + 1;
IF n > 2 THEN
	high := TRUE;
ELSE
	low := TRUE;
END_IF
IF n > 100 THEN
	n := Half(n);
END_IF
END_PROGRAM
"""
FILES = {
    "main/Main.st": MAIN,
    "main/Main.var": "VAR n : INT; high : BOOL; low : BOOL; END_VAR\n",
    "lib/lib.fun": "FUNCTION Half : INT VAR_INPUT n : INT; END_VAR END_FUNCTION\n",
    "lib/Half.st": "FUNCTION Half\nHalf := n / 2;\nEND_FUNCTION\n",
}


@pytest.fixture
def measuring(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    found = coverage.Measuring()
    found.is_on = found.is_collected = True
    for module in ("code", "library", "linkage"):
        monkeypatch.setattr(f"plcsim.program.structured_text.{module}.MEASURING", found)
    return found


def names(found):
    return {Path(path).name: seen for path, seen in found.items()}


@pytest.mark.parametrize("repeated", [False, True])
def test_lines_and_ways_that_have_run(run, measuring, repeated):
    if repeated:
        run(FILES, 1)  # from the cache the second time
        measuring.collect()
    run(FILES, 1)
    found = names(measuring.collect())
    assert found["Main.st"].lines == {2, 3, 6, 8}
    assert (3, 6) in found["Main.st"].ways
    assert (3, 4) not in found["Main.st"].ways
    assert found["Half.st"].lines == set()
    run(FILES, 3)
    found = names(measuring.collect())
    assert found["Main.st"].lines == {2, 3, 4, 6, 8}
    assert {(3, 4), (3, 6)} <= found["Main.st"].ways
    assert measuring.collect() == {}


def test_what_can_run_is_known_by_the_text(run, measuring):
    run(FILES, 1)
    seen = coverage.possible_in(MAIN)
    assert seen.lines == {2, 3, 4, 6, 8, 9}
    assert coverage.exits_of(seen.ways) == {3: 2, 8: 2}
    assert coverage.possible_in(FILES["lib/Half.st"]).lines == {1, 2}
    assert coverage.possible_in("nothing") is None


def test_nothing_is_counted_where_nobody_measures(run, monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    run(FILES, 1)
    assert coverage.MEASURING.collect() == {}
    assert coverage.possible_in(MAIN) is None
