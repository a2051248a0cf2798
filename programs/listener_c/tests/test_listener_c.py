"""The listener in C, and that it does as its twin in Python."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from crosnode.testing import Ros
from plcsim.project.assembly import load
from plcsim.project.plc_toml import read_project
from plcsim.testing import Plc, Trace

TYPE = "prova/hello"
PROGRAMS = Path(__file__).parents[2]
TAGS = ("listener.word", "listener.heard", "listener.lost")


def test_it_hears_and_says_so_on_rosout(plc: Plc, ros: Ros) -> None:
    log = ros.subscribe("/rosout", "rosgraph_msgs/Log")
    plc.until(lambda: log.publishers)
    ros.publish("/chatter", TYPE, aWord="grüß dich €")
    plc.assert_within("10ms", {"listener.word": "grüß dich ?", "listener.heard": 1})
    plc.until(lambda: log.queue)
    entry = log.pop()
    assert entry is not None
    assert entry.msg == "I heard: [grüß dich ?]"


def test_a_word_that_is_too_long_is_cut_and_the_status_says_so(plc: Plc, ros: Ros) -> None:
    ros.publish("/chatter", TYPE, aWord="x" * 100)
    plc.until({"listener.heard": 1})
    assert plc["listener.word"] == "x" * 80


def test_every_word_is_counted(plc: Plc, ros: Ros) -> None:
    for number in range(100):
        ros.publish("/chatter", TYPE, aWord=f"word {number}")
        plc.cycles(1)
    plc.assert_within("10ms", {"listener.heard": 100, "listener.word": "word 99"})
    assert plc["listener.lost"] == 0


@contextmanager
def running(project: str) -> Iterator[tuple[Plc, Ros]]:
    plc = Plc(load(read_project(PROGRAMS / project)))
    ros = Ros(plc)
    plc.boot()
    yield plc, ros
    plc.close()


def trace_of(project: str) -> Trace:
    """Record a listener that hears words of all kinds, on a good line and on a bad one."""
    with running(project) as (plc, ros):
        trace = plc.record(*TAGS)
        for word in ("one", "grüß dich €", "gr\udcfc\udcdf", "", "x" * 100):
            ros.publish("/chatter", TYPE, aWord=word)
            plc.run("7ms")
        plc.faults.latency("30ms", for_="1s")
        for number in range(1_000):
            ros.publish("/chatter", TYPE, aWord=f"word {number}")
            if number % 2:
                plc.cycles(1)
        plc.run("2s")
    return trace


def test_its_tags_are_those_of_its_twin_in_python() -> None:
    own, twin = trace_of("listener_c"), trace_of("listener")
    assert len(own) > 100
    assert own.rows == twin.rows
