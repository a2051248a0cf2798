"""Diagrams in docs/ from the tables in the code."""

import sys
from enum import Enum, auto
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import pytest

TOP = Path(__file__).parents[3]
NAME = "state_diagrams"


@pytest.fixture(scope="module")
def tool():
    """The module, loaded from its file: tools/ is no package."""
    spec = spec_from_file_location(NAME, TOP / "tools" / f"{NAME}.py")
    module = module_from_spec(spec)
    sys.modules[NAME] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[NAME]


class Lamp(Enum):
    OFF = auto()
    ON = auto()
    BROKEN = auto()


class Act(Enum):
    PRESS = "somebody presses: the button; hard"
    BURN_OUT = 2


TABLE = {Lamp.OFF: {Act.PRESS: Lamp.ON}, Lamp.ON: {Act.PRESS: Lamp.OFF, Act.BURN_OUT: Lamp.BROKEN}}

DIAGRAM = """\
```mermaid
stateDiagram-v2
    [*] --> OFF
    OFF --> ON: somebody presses the button, hard
    ON --> OFF: somebody presses the button, hard
    ON --> BROKEN: burn out
    BROKEN --> [*]
```
"""


def test_a_table_becomes_a_diagram(tool):
    assert tool.diagram(TABLE) == DIAGRAM


@pytest.fixture
def page(tool, tmp_path, monkeypatch):
    """``page(text)``: a page of a folder of documentation, as it is after the command."""
    monkeypatch.setitem(sys.modules, "lamps", sys.modules[__name__])

    def page(text):
        file = tmp_path / "deep" / "page.md"
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
        assert tool.main(tmp_path) == 0
        return file.read_text()

    return page


HEAD, FOOT = "<!-- states of lamps:TABLE -->\n", "<!-- end of states -->"


def test_a_page_gets_the_diagrams_it_asks_for_and_keeps_the_rest(page):
    blocks = f"A\n{HEAD}old\n{FOOT}\nB\n{HEAD}{FOOT}\nC\n"
    wanted = f"A\n{HEAD}{DIAGRAM}{FOOT}\nB\n{HEAD}{DIAGRAM}{FOOT}\nC\n"
    assert page(blocks) == wanted
    assert page(wanted) == wanted


def test_a_page_that_asks_for_none_is_left_alone(page):
    assert page("no diagram\n") == "no diagram\n"


def test_the_diagrams_of_the_documentation_are_fresh(tool):
    pages = sorted((TOP / "docs").rglob("*.md"))
    stale = [p.name for p in pages if tool.renew(p.read_text("utf-8")) != p.read_text("utf-8")]
    assert not stale, "run python tools/state_diagrams.py"
    assert any("<!-- states of plcsim.core.system:TRANSITIONS -->" in p.read_text() for p in pages)
