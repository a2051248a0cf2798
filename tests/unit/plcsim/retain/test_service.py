"""The service writes what has changed, once, and the end of a run."""

import pytest

from plcsim.retain.errors import RetainError
from plcsim.retain.generations import Generations
from plcsim.retain.service import Keeper


def numbers(site):
    latest, _ = Generations(site.retain).latest()
    return None if latest is None else latest.number


def test_nothing_is_written_before_the_first_snapshot(site):
    _, service = site.start()
    service.is_stopping = True
    Keeper(service).run()
    assert numbers(site) is None


def test_only_a_change_is_written(site):
    controller, service = site.start()
    keeper = Keeper(service)
    site.retain.mkdir()
    for cycles, number in ((1, 1), (0, 1), (2, 2)):
        controller.run(cycles=cycles) if cycles else None
        keeper.look()
        assert numbers(site) == number
    latest, _ = Generations(site.retain).latest()
    assert [v.path for v in latest.variables] == ["gTotal", "gName", "press.parts"]
    assert latest.data == b"\6\0\0\0one\0\0\0\0\0\0\x08\0\0\0"


def test_what_the_files_hold_already_is_not_written_again(site):
    controller, service = site.start()
    controller.run(cycles=1)
    service.is_stopping = True
    Keeper(service).run()
    Keeper(service).run()
    assert numbers(site) == 1
    assert service.told[0] == (
        f"keeping 3 variables in {site.retain}, 100 ms after a change at the latest"
    )


def test_two_runs_do_not_share_a_folder(site):
    _, service = site.start()
    with Generations(site.retain).locked(), pytest.raises(RetainError, match="another run"):
        Keeper(service).run()
