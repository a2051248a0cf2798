from pathlib import Path

import pytest

from plcsim import Program
from plcsim.core.controller import Controller
from plcsim.core.errors import ConfigurationError
from plcsim.project.assembly import Application, load
from plcsim.project.plc_toml import read_project
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
    return writers(lambda watch: Replay(application, head, records, watch), path, HERE, 0, cycle)


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


TANK = """\
PROGRAM _CYCLIC
    count := count + 1;
    IF count MOD 3 = 0 THEN
        level := 5;
    ELSE
        level := count;
    END_IF
END_PROGRAM
"""

PUMP = """\
#include <bur/plctypes.h>
_LOCAL UDINT count, level;

static void put(UDINT *to, UDINT value)
{
    *to = value;
}

void _CYCLIC ProgramCyclic(void)
{
    put(&count, count + 1);
    level = count % 3 ? count : 5;
}
"""


@pytest.mark.parametrize(
    ("file", "text", "lines"),
    [("main.st", TANK, {"1": 6, "2": 6, "5": 4}), ("main.c", PUMP, dict.fromkeys("125", 12))],
)
def test_lines_of_compiled_programs_are_told(
    recordings: Recordings, file: str, text: str, lines: dict[str, int]
) -> None:
    folder = recordings.folder / "cell"
    (folder / "tank").mkdir(parents=True)
    (folder / "tank" / file).write_text(text)
    (folder / "tank" / "main.var").write_text("VAR\n    count, level : UDINT;\nEND_VAR\n")
    (folder / "plc.toml").write_text('[task_class.1]\ncycle = "10ms"\nprograms = ["tank"]\n')
    try:
        application = load(read_project(folder))
    except ConfigurationError as err:
        if "compiler" in str(err):
            pytest.skip("no compiler for C is installed")
        raise
    bag = recordings("a.bag", application)

    with open_bag(bag) as reader:
        head, records = reader.head(), list(reader.records())
    found = writers(
        lambda watch: Replay(application, head, records, watch), "tank.level", folder, 0, 3
    )

    written = [(each.value, each.location) for each in found if each.by == "tank"]
    assert written == [(v, f"tank/{file}:{lines[v]}") for v in ("1", "2", "5")]
