from pathlib import Path
from typing import Any

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.recorder.bag.writing import Limits
from plcsim.recorder.settings import RecordProject, read_settings
from plcsim.settings import Table


def read(folder: Path, **keys: Any) -> RecordProject:
    return read_settings(Table(folder / "plc.toml", "record", keys))


def test_an_empty_table_records_everything_into_one_file(tmp_path: Path) -> None:
    made = read(tmp_path)

    assert made.file == tmp_path.resolve() / "recordings" / "run.bag"
    assert made.settings.limits == Limits()
    assert made.settings.tags == ()


def test_every_key_has_its_unit(tmp_path: Path) -> None:
    made = read(tmp_path, file="a.mcap", size="2MiB", duration="10s", files=3, tags=["*"])

    assert made.settings.limits == Limits(2 << 20, 10_000_000_000, 3)
    assert made.settings.tags == ("*",)


@pytest.mark.parametrize(
    ("key", "value", "text"),
    [
        ("file", "a.txt", r"record\.file: .*ends in \.bag"),
        ("buffer", "1KiB", r"record\.buffer"),
        ("fiel", "a.bag", "did you mean"),
        ("files", -1, r"record\.files"),
    ],
)
def test_what_is_wrong_is_named(tmp_path: Path, key: str, value: Any, text: str) -> None:
    with pytest.raises(ConfigurationError, match=text):
        read(tmp_path, **{key: value})
