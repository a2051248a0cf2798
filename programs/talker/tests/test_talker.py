"""The talker and what a subscriber on another computer hears of it."""

from crosnode.testing import Ros
from plcsim.testing import Plc

TYPE = "prova/hello"


def test_the_talker_says_its_word_once_a_second(plc: Plc, ros: Ros) -> None:
    chatter = ros.subscribe("/chatter", TYPE)
    plc.run("3500ms")
    assert [message.aWord for message in iter(chatter.pop, None)] == ["Hello world!!!"] * 3
    assert plc["talker.sent"] == 4
    assert plc["talker.subscribers"] == 1


def test_the_word_can_be_changed(plc: Plc, ros: Ros) -> None:
    chatter = ros.subscribe("/chatter", TYPE)
    plc["talker.word"] = "grüß dich"
    plc.until(lambda: chatter.queue)
    message = chatter.pop()
    assert message is not None
    assert message.aWord == "grüß dich"


def test_a_master_that_is_started_again_finds_the_talker(plc: Plc, ros: Ros) -> None:
    plc.until(lambda: "/chatter" in ros.system_state().publishers)
    ros.stop_master()
    plc.run("5s")
    ros.start_master()
    plc.until(lambda: ros.system_state().publishers.get("/chatter") == ["/talker_cros"])


def test_a_subscriber_that_leaves_is_not_counted_any_more(plc: Plc, ros: Ros) -> None:
    ros.subscribe("/chatter", TYPE)
    plc.until({"talker.subscribers": 1})
    ros.tester.close()
    plc.until({"talker.subscribers": 0})


def test_a_subscriber_comes_back_after_its_connection_was_lost(plc: Plc, ros: Ros) -> None:
    ros.subscribe("/chatter", TYPE)
    plc.until({"talker.subscribers": 1})
    plc.faults.reset(ros.tester.host)
    plc.until({"talker.subscribers": 0})
    plc.until({"talker.subscribers": 1})


def test_after_exit_nothing_is_registered(plc: Plc, ros: Ros) -> None:
    plc.until(lambda: "/chatter" in ros.system_state().publishers)
    plc.stop()
    assert "/chatter" not in ros.system_state().publishers
