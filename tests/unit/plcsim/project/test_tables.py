"""Programs and times as plc.toml has them; what can be wrong is in test_plc_toml.py."""

from datetime import date, datetime, timedelta, timezone
from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.project.tables import (
    PlcSettings,
    ProgramEntry,
    ProgramKind,
    TaskClassTable,
    task_class_entry,
)
from plcsim.settings import Table

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


@pytest.mark.parametrize(
    ("value", "seconds"),
    [
        (datetime(2026, 3, 31, 6), 1_774_936_800),  # noqa: DTZ001  # as TOML gives it
        (datetime(2026, 3, 31, 8, tzinfo=timezone(timedelta(hours=2))), 1_774_936_800),
        (date(1970, 1, 2), 86_400),
    ],
)
def test_a_date_of_the_start(value, seconds):
    found = Table(Path("plc.toml"), "plc", {"start_date": value}).read(PlcSettings)
    assert found.start_date_ns == seconds * 1_000_000_000


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("2026-03-31", r"'2026-03-31' is not a date and time such as 2026-03-31T06:00:00"),
        (datetime(1969, 12, 31), r"1969-12-31 00:00:00 does not lie between 1970 and 2099"),  # noqa: DTZ001  # as TOML gives it
        (datetime(2100, 1, 1), r"2100-01-01 00:00:00 does not lie between 1970 and 2099"),  # noqa: DTZ001  # as TOML gives it
    ],
)
def test_no_date_of_the_start(value, message):
    with pytest.raises(ConfigurationError, match=message):
        Table(Path("plc.toml"), "plc", {"start_date": value}).read(PlcSettings)
