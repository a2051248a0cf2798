"""Warnings of the logbook while the PLC runs."""

import pytest

from plcsim.cli.live_logbook import LiveLogbook
from plcsim.core.logbook import Severity
from plcsim.core.task import Policy
from plcsim.shared_image import ImageNotReady, ImageReader, ImageWriter
from plcsim.shared_image.layout import make_file

S = 1_000_000_000
MS = 1_000_000


@pytest.fixture
def live(make_controller, task_class, program_of, clock):
    """``live(program)``: a controller with its image, what is printed, and the printer."""

    def live(program=None, settings=None):
        fd = make_file()
        lines = []

        def events():
            try:
                return ImageReader(fd).events(from_oldest=True)
            except ImageNotReady:
                return None

        logbook = LiveLogbook(events, lines.append)
        logbook.look(0)
        controller = make_controller(task_class(1, 10, settings, p=program or program_of()))
        ImageWriter(fd, controller, project="cell", services={})
        return controller, lines, logbook

    return live


def test_warnings_are_printed_once_and_nothing_else(live):
    controller, lines, logbook = live()
    controller.log(Severity.WARNING, "ros", "no master\x1b[2J")
    controller.log(Severity.INFORMATION, "system", "RUN")
    controller.log(Severity.ERROR, "p", "division by zero")
    logbook.look(1)
    logbook.look(2)
    assert lines == ["     0.000000 s  ros: no master\\x1b[2J"]
    assert logbook.shown == {(0, "ros", "no master\x1b[2J")}


def test_before_the_image_is_there_nothing_is_printed(live):
    _, lines, _ = live()
    assert lines == []


def test_many_warnings_are_counted(live):
    controller, lines, logbook = live()
    for number in range(25):
        controller.log(Severity.WARNING, "p", f"warning {number}")
    logbook.look(5 * S)
    assert len(lines) == 10
    logbook.look(6 * S - 1)
    assert len(lines) == 10
    controller.log(Severity.WARNING, "p", "one more")
    logbook.look(6 * S)
    assert lines[10:] == [
        "... and 15 more entries of the logbook",
        "     0.000000 s  p: one more",
    ]


def test_violations_by_the_host_are_one_line(live, program_of, clock):
    controller, lines, logbook = live(program_of(lambda _: clock.stall_ns(30 * MS)))
    controller.boot()
    controller.run(cycles=3)
    logbook.look(1)
    (line,) = lines
    assert line.endswith(
        " s  task class 1: cycle time violations by the host: plcsim doctor says why"
    )


def test_violations_by_a_program_are_told_one_by_one(live, program_of, clock):
    settings = {"policy": Policy.LOG}
    controller, lines, logbook = live(program_of(lambda _: clock.spend_ns(30 * MS)), settings)
    controller.boot()
    controller.run(cycles=3)
    logbook.look(1)
    assert len(lines) == 3
    assert "cause program" in lines[0]
