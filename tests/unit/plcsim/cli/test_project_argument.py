"""PROJECT on the command line: optional inside a project's folder."""

from pathlib import Path

import pytest

from plcsim.cli.parser import CommandParser
from plcsim.cli.project_argument import (
    add_project,
    add_project_and_tags,
    own_project,
    project_and_tags,
)


@pytest.fixture
def plants(tmp_path, monkeypatch):
    """Two projects beside each other, ``cell`` with a folder ``main``; a test stands above them."""
    for name in ("cell", "tank"):
        (tmp_path / name / "main").mkdir(parents=True)
        (tmp_path / name / "plc.toml").touch()
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ("folder", "project"), [("cell", "."), ("cell/main", ".."), (".", "."), ("/", ".")]
)
def test_the_own_project_is_the_nearest_above(plants, monkeypatch, folder, project):
    monkeypatch.chdir(folder)
    assert own_project() == Path(project)


def test_a_project_that_is_named_is_taken(plants, monkeypatch):
    monkeypatch.chdir("cell")
    parser = CommandParser()
    add_project(parser)
    assert parser.parse_args([]).project == Path()
    assert parser.parse_args(["../tank"]).project == Path("../tank")


@pytest.mark.parametrize(
    ("folder", "words", "project", "tags"),
    [
        (".", ["cell"], "cell", []),
        (".", ["cell/plc.toml", "main.x"], "cell/plc.toml", ["main.x"]),
        (".", ["nowhere", "main.x"], "nowhere", ["main.x"]),
        ("cell", [], ".", []),
        ("cell", ["main.x", "main.y"], ".", ["main.x", "main.y"]),
        ("cell", ["main"], ".", ["main"]),  # a program, and a folder that is no project
        ("cell/main", ["main.x"], "..", ["main.x"]),
        ("cell", ["../tank", "main.x"], "../tank", ["main.x"]),
    ],
)
def test_the_first_word_is_the_project_where_it_is_one(
    plants, monkeypatch, folder, words, project, tags
):
    monkeypatch.chdir(folder)
    parser = CommandParser()
    add_project_and_tags(parser, "")
    assert project_and_tags(parser.parse_args(words)) == (Path(project), tags)
