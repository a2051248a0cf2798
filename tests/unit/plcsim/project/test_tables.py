"""Programs and times as plc.toml has them; what can be wrong is in test_plc_toml.py."""

from pathlib import Path

import pytest

from plcsim.project.tables import (
    PlcSettings,
    ProgramEntry,
    ProgramKind,
    TaskClassTable,
    task_class_entry,
)

MS = 1_000_000


@pytest.mark.parametrize(
    ("value", "entry"),
    [
        ("a", ("a", "a")),
        ({"name": "a"}, ("a", "a")),
        ({"name": "a", "source": "lines/b"}, ("a", "lines/b")),
    ],
)
def test_a_program_is_a_name_or_a_table(value: object, entry: tuple[str, str]) -> None:
    assert ProgramKind().convert(value, Path()) == ProgramEntry(*entry)


def test_a_tolerance_of_0_is_not_the_default() -> None:
    assert task_class_entry(1, TaskClassTable()).tolerance_ns == 10 * MS
    table = TaskClassTable(tolerance_ns=0, first_release_ns=0, cycle_ns=4 * MS)
    entry = task_class_entry(1, table)
    assert (entry.cycle_ns, entry.tolerance_ns, entry.first_release_ns) == (4 * MS, 0, 0)


def test_the_processor_may_be_any() -> None:
    assert PlcSettings().pinned_cpu is None
    assert PlcSettings(cpu=0).pinned_cpu == 0
