"""The listener, and a publisher on another computer."""

import pytest

from crosnode.testing import Ros
from plcsim.testing import Plc

TYPE = "prova/hello"


def test_the_listener_hears_and_says_so_on_rosout(plc: Plc, ros: Ros) -> None:
    log = ros.subscribe("/rosout", "rosgraph_msgs/Log")
    plc.until(lambda: log.publishers)
    ros.publish("/chatter", TYPE, aWord="grüß dich €")
    plc.assert_within("10ms", {"listener.word": "grüß dich ?", "listener.heard": 1})
    plc.until(lambda: log.queue)
    entry = log.pop()
    assert entry is not None
    assert entry.msg == "I heard: [grüß dich €]"


def test_a_word_that_is_not_utf8_is_heard(plc: Plc, ros: Ros) -> None:
    """As a roscpp node sends it whose author saved the file as Latin-1."""
    ros.publish("/chatter", TYPE, aWord="gr\udcfc\udcdf")
    plc.assert_within("10ms", {"listener.word": "grüß", "listener.heard": 1})


def test_every_word_is_counted(plc: Plc, ros: Ros) -> None:
    for number in range(100):
        ros.publish("/chatter", TYPE, aWord=f"word {number}")
        plc.cycles(1)
    plc.assert_within("10ms", {"listener.heard": 100, "listener.word": "word 99"})
    assert plc["listener.lost"] == 0


@pytest.mark.plc(seeds=5)
def test_a_bad_line_delays_words_and_loses_none(plc: Plc, ros: Ros) -> None:
    plc.faults.latency("30ms", for_="1s")
    plc.faults.short_sends(largest=5, host=ros.tester.host, for_="1s")
    for number in range(10):
        ros.publish("/chatter", TYPE, aWord=f"word {number}")
    plc.assert_within("500ms", {"listener.heard": 10, "listener.word": "word 9"})
    plc.run("1s")  # EXIT would wait for the master on a bad line
