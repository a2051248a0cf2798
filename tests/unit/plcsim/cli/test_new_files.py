"""plcsim new: the keys of plc.toml that it shows as comments are all there are, as they are."""

import re
import tomllib
from dataclasses import replace

import pytest

from plcsim.cli.new import _examples
from plcsim.cli.new_files import commented
from plcsim.project.plc_toml import read_project
from plcsim.project.tables import PlcSettings, TaskClassTable
from plcsim.settings.declaration import declared

EXAMPLES = _examples()
_COMMENTED_KEY = re.compile(r"^# (\[plc\]|\w+ = .*)$", re.MULTILINE)


def plc_toml(example):
    return (EXAMPLES[example] / "plc.toml").read_text("utf-8")


def uncommented(text):
    """Take away the # before every key."""
    return _COMMENTED_KEY.sub(r"\1", text)


@pytest.mark.parametrize("example", sorted(EXAMPLES))
def test_nothing_is_changed_by_the_comments(example):
    text = plc_toml(example)
    assert tomllib.loads(commented(text, "my_plc")) == tomllib.loads(text)


@pytest.mark.parametrize("example", sorted(EXAMPLES))
def test_every_key_is_there_once(example):
    found = tomllib.loads(uncommented(commented(plc_toml(example), "my_plc")))
    assert set(found["plc"]) == {setting.key for setting in declared(PlcSettings)}
    for table in found["task_class"].values():
        assert set(table) == {setting.key for setting in declared(TaskClassTable)}


def test_without_its_sign_of_a_comment_a_key_has_its_default(project):
    text = plc_toml("blinky")
    plain = read_project(project({"plc.toml": text}))
    keys = uncommented(commented(text, "cell"))
    for name in ("exception_program", "start_date"):  # what they are by default cannot be written
        keys = keys.replace(name, "# ")
    found = read_project(project({"plc.toml": keys}))
    assert found.plc == replace(plain.plc, name="cell")
    assert found.classes == plain.classes
