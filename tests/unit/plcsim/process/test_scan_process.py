"""The order of a run; what a scan process does with it is in tests/scan/test_supervisor.py."""

import json

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.host import realtime
from plcsim.host.realtime import Rights
from plcsim.process import scan_process
from plcsim.process.scan_process import RunOrder, file_of
from plcsim.process.scan_process import project_of as project_from
from plcsim.project.plc_toml import read_project

ORDER = RunOrder(1, 9, False, None, 5, False, 3, 4, 5, 6, 7, [8])


def test_an_order_comes_through_as_it_is():
    assert RunOrder(**json.loads(ORDER.to_json())) == ORDER


def test_the_project_comes_through_as_its_parent_read_it(project_of):
    project = read_project(project_of("", "tolerance = '1ms'", plc='tick = "500us"'))
    assert project_from(file_of(project)) == project


@pytest.mark.parametrize("setting", ["require", "auto"])
def test_rights_that_are_required_and_refused_name_the_file(project_of, monkeypatch, setting):
    refused = Rights((), ("SCHED_FIFO: Operation not permitted",))
    monkeypatch.setattr(realtime, "acquire", lambda *_: refused)
    project = read_project(project_of("", plc=f'realtime = "{setting}"'))
    if setting == "auto":
        assert scan_process._take_rights(project, ORDER) == refused
        return
    text = r"/plc.toml: plc.realtime: required, but not given: SCHED_FIFO: Operation not perm"
    with pytest.raises(ConfigurationError, match=text):
        scan_process._take_rights(project, ORDER)
