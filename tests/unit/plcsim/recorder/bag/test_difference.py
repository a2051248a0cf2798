from plcsim import Program
from plcsim.core.controller import Controller
from plcsim.recorder.bag.difference import difference
from plcsim.recorder.bag.reading import open_bag
from st_types import UINT, var

from ..conftest import Fast, Recordings, Slow, application_of


def tell(controller: Controller) -> None:
    controller.tags.write(controller.tags.find("Fast.told"), 5)


def differences(recordings: Recordings, *bags: str) -> str:
    paths = [recordings.folder / bag for bag in bags]
    with open_bag(paths[0]) as first, open_bag(paths[1]) as second:
        return difference(first, second)


def test_two_runs_that_are_the_same_do_not_differ(recordings: Recordings) -> None:
    for file in ("a.bag", "b.bag"):
        recordings(file, application_of(Fast, Slow))

    assert differences(recordings, "a.bag", "b.bag") == ""
    assert (recordings.folder / "a.bag").read_bytes() == (recordings.folder / "b.bag").read_bytes()


def test_one_input_that_differs_is_named_with_its_cycle(recordings: Recordings) -> None:
    recordings("a.bag", application_of(Fast))
    recordings("b.bag", application_of(Fast), act=tell)

    found = differences(recordings, "a.bag", "b.bag")
    told = "Fast.told is 0 against 5, Fast.doubled is 0 against 10"
    assert found == f"cycle 21 of task class 1: {told}"


def test_a_recording_that_ends_early_is_named(recordings: Recordings) -> None:
    recordings("a.bag", application_of(Fast))
    recordings("b.bag", application_of(Fast), cycles=10)

    found = differences(recordings, "a.bag", "b.bag")
    assert found == f"{recordings.folder / 'b.bag'} ends before cycle 21 of task class 1"


def test_other_variables_are_named(recordings: Recordings) -> None:
    class Other(Program):
        count = var(UINT)

    recordings("a.bag", application_of(Fast))
    recordings("b.bag", application_of(Other))

    assert differences(recordings, "a.bag", "b.bag") == "the variables of Fast are others"


def test_formats_of_two_kinds_can_be_compared(recordings: Recordings) -> None:
    recordings("a.bag", application_of(Fast))
    recordings("b.mcap", application_of(Fast))

    assert differences(recordings, "a.bag", "b.mcap") == ""
