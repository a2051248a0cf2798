"""The talker in C: what others hear of it, and that it does as its twin in Python."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from crosnode.testing import Ros
from plcsim.project.assembly import load
from plcsim.project.plc_toml import read_project
from plcsim.testing import Plc, Trace

TYPE = "prova/hello"
PROGRAMS = Path(__file__).parents[2]
TAGS = ("talker.word", "talker.sent", "talker.subscribers")


def test_it_says_its_word_once_a_second(plc: Plc, ros: Ros) -> None:
    chatter = ros.subscribe("/chatter", TYPE)
    plc.run("3500ms")
    assert [message.aWord for message in iter(chatter.pop, None)] == ["Hello world!!!"] * 3
    assert (plc["talker.sent"], plc["talker.subscribers"]) == (4, 1)


def test_the_word_can_be_changed(plc: Plc, ros: Ros) -> None:
    chatter = ros.subscribe("/chatter", TYPE)
    plc["talker.word"] = "grüß dich"
    plc.until(lambda: chatter.queue)
    message = chatter.pop()
    assert message is not None
    assert message.aWord == "grüß dich"


def test_after_exit_nothing_is_registered(plc: Plc, ros: Ros) -> None:
    plc.until(lambda: "/chatter" in ros.system_state().publishers)
    plc.stop()
    assert "/chatter" not in ros.system_state().publishers


@contextmanager
def running(project: str) -> Iterator[tuple[Plc, Ros]]:
    plc = Plc(load(read_project(PROGRAMS / project)))
    ros = Ros(plc)
    plc.boot()
    yield plc, ros
    plc.close()


def trace_of(project: str) -> Trace:
    """Record a talker that a subscriber comes to, leaves, and comes back to after a lost master."""
    with running(project) as (plc, ros):
        trace = plc.record(*TAGS)
        plc.run("1500ms")
        ros.subscribe("/chatter", TYPE)
        plc.run("2s")
        plc.faults.reset(ros.tester.host)
        plc.run("500ms")
        ros.stop_master()
        plc["talker.word"] = "again"
        plc.run("2s")
        ros.start_master()
        plc.run("3s")
        ros.tester.close()
        plc.run("1s")
    return trace


def test_its_tags_are_those_of_its_twin_in_python() -> None:
    own, twin = trace_of("talker_c"), trace_of("talker")
    assert len(own) > 10
    assert own.rows == twin.rows
