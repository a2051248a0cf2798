import pytest

from plcsim.access import Role, Users, users
from plcsim.core.errors import ConfigurationError
from plcsim.web import extension
from plcsim.web.extension import EXTENSION
from plcsim.web.settings import WebProject, WebSettings


def test_what_the_pages_are_told_is_json_and_needs_no_snapshot(world):
    given = world.service.given
    assert given["classes"] == [
        {
            "number": 1,
            "cycle_ns": 1_000_000,
            "tolerance_ns": 0,
            "policy": "service",
            "tasks": ["p"],
        }
    ]
    assert given["tasks"] == ["p"]
    assert given["is_virtual"] is True


def test_pages_for_other_machines_need_users(world, tmp_path, monkeypatch):
    project = WebProject(WebSettings(host="0.0.0.0"), tmp_path)
    with pytest.raises(ConfigurationError, match="plcsim users add NAME"):
        EXTENSION.check(project, world.plc)
    Users(users.users_file(tmp_path)).add_token("panel", Role.LOOK)
    assert EXTENSION.check(project, world.plc) == ()
    assert EXTENSION.check(WebProject(WebSettings(), tmp_path), world.plc) == ()


def test_packages_that_are_missing_are_named(world, tmp_path, monkeypatch):
    monkeypatch.setattr(extension, "NEEDED", ("starlette", "no_such_package"))
    with pytest.raises(ConfigurationError, match=r"needs no_such_package.*plcsim\[web\]"):
        EXTENSION.check(WebProject(WebSettings(), tmp_path), world.plc)
