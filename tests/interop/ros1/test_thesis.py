"""The thesis' test (section 1.3.2): our talker, a roscpp listener; and the reverse."""

from pathlib import Path

import pytest

from .rig import Ros


@pytest.mark.parametrize("program", ["talker", "talker_st"])
def test_our_talker_and_a_roscpp_listener(ros: Ros, roscpp: Path, program: str) -> None:
    talker = ros.program(program)
    listener = ros.start([str(roscpp / "listener")])
    ros.until(lambda: listener.text.count("I heard: [Hello world!!!]") >= 3)
    assert talker.is_running


@pytest.mark.parametrize("program", ["listener", "listener_st"])
def test_a_roscpp_talker_and_our_listener(ros: Ros, roscpp: Path, program: str) -> None:
    ros.program(program)
    ros.start([str(roscpp / "talker")])
    said = ros.tool("rostopic", "echo", "-n", "20", "/rosout/msg")
    assert said.count("I heard: [roscpp ") >= 10
