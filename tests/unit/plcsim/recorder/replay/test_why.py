from pathlib import Path

import pytest

from plcsim import Program
from plcsim.core.controller import Controller
from plcsim.project.assembly import Application
from plcsim.recorder.bag.reading import open_bag
from plcsim.recorder.errors import RecordingError
from plcsim.recorder.replay.replay import Replay
from plcsim.recorder.replay.why import LATCH, Written, writers
from st_types import UINT, var

from ..conftest import Recordings, Slow, application_of

HERE = Path(__file__).parent


class Fast(Program):
    """Counts to three and begins again."""

    count = var(UINT)
    told = var(UINT)
    lamp = var(UINT)

    def cyclic(self) -> None:
        self.count += 1
        if self.count == 3:
            self.count = 0  # the line that is looked for


def ask(bag: Path, application: Application, path: str, cycle: int = 0) -> list[Written]:
    with open_bag(bag) as reader:
        head, records = reader.head(), list(reader.records())
    return writers(lambda: Replay(application, head, records), path, HERE, 0, cycle)


def line_of(text: str) -> int:
    lines = Path(__file__).read_text().splitlines()
    return next(number for number, line in enumerate(lines, 1) if text in line)


def test_the_last_writers_are_told_with_program_line_and_cycle(recordings: Recordings) -> None:
    application = application_of(Fast, Slow)

    found = ask(recordings("a.bag", application), application, "Fast.count", 6)

    assert [(each.cycle, each.value) for each in found[-3:]] == [(5, "2"), (6, "3"), (6, "0")]
    assert {each.by for each in found} == {"Fast"}
    place = f"{Path(__file__).name}:{line_of('# the line that is looked for')}"
    assert found[-1].location == place


def test_what_came_from_outside_is_told(recordings: Recordings) -> None:
    def tell_count(controller: Controller) -> None:
        address = controller.tags.find("Fast.told").address
        controller.memory.write(address, b"\5\0")
        for told in controller.image.followers:
            told(address, b"\5\0")

    application = application_of(Fast)
    found = ask(recordings("a.bag", application, act=tell_count), application, "Fast.told")

    assert found[-1].value == "5"
    assert found[-1].cycle == 21
    assert LATCH not in {each.by for each in found}  # it was written between two cycles


def test_a_tag_that_is_not_there_is_told(recordings: Recordings) -> None:
    application = application_of(Fast)
    bag = recordings("a.bag", application)

    with pytest.raises(RecordingError, match=r"Fast\.cuont"):
        ask(bag, application, "Fast.cuont")
