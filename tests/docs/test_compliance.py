"""docs/compliance.md names tests that are there."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SECTION = re.compile(r"^### Each fact.*?(?=^## )", re.MULTILINE | re.DOTALL)
ROWS = [
    [cell.strip() for cell in row.strip("|").split(" | ")]
    for row in SECTION.findall((ROOT / "docs" / "compliance.md").read_text("utf-8"))[0].splitlines()
    if row.startswith("| ") and not row.endswith("| tests |")
]
CORPUS = ROOT / "tests" / "corpus" / "structured_text"


def is_there(name: str) -> bool:
    """Whether a test is there: ``FILE.txt: title`` of a corpus, or ``PATH.py::test``."""
    if ".txt: " in name:
        file, _, title = name.partition(": ")
        return f"\n==== {title}\n" in "\n" + (CORPUS / file).read_text("utf-8")
    path, _, function = name.partition("::")
    files = [file for file in (ROOT / "tests").rglob(Path(path).name) if file.match(path)]
    return any(f"\ndef {function}(" in file.read_text("utf-8") for file in files)


@pytest.mark.parametrize("row", ROWS, ids=[row[0] for row in ROWS])
def test_each_fact_names_tests_that_are_there(row: list[str]) -> None:
    names = re.findall(r"`([^`]+)`", row[-1])
    assert names
    assert [name for name in names if not is_there(name)] == []


def test_what_is_not_there_is_found() -> None:
    assert len(ROWS) > 40
    assert not is_there("semantics.txt: nothing of this kind")
    assert not is_there("test_calls.py::test_nothing")
