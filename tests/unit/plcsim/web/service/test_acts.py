import pytest

from plcsim.access import Role
from plcsim.core.errors import PlcError
from plcsim.web.service.acts import ACTS, perform
from plcsim.web.service.door import RefusedError

from ..site import caller


def do(world, name, role=Role.ENGINEER, **arguments):
    return world.do(lambda: perform(world.hub, caller(role), name, arguments))


def test_a_write_is_applied_answered_and_noted(world):
    assert do(world, "write", tag="P.Level", value="2.5") == {
        "tag": "P.Level",
        "before": "1.5",
        "value": "2.5",
    }
    assert world.value("p.level") == 2.5
    (line,) = world.audit()
    assert line.pop("time").endswith("+00:00")
    assert line == {
        "who": "anna",
        "role": "engineer",
        "peer": "127.0.0.1",
        "act": "write",
        "tag": "P.Level",
        "before": "1.5",
        "value": "2.5",
    }


@pytest.mark.parametrize(
    ("tag", "value", "why"),
    [
        ("p.level", "much", "much"),
        ("p.small", "40000", "40000"),
        ("p.mode", "SIDEWAYS", "SIDEWAYS"),
        ("p.levl", "1", "did you mean p.level"),
        ("p.level", 7, "must be a text"),
        (None, "1", "must be a text"),
        ("p.level", "1" * 20_000, "at most"),
    ],
)
def test_a_wrong_write_changes_nothing_and_says_why(world, tag, value, why):
    with pytest.raises(PlcError, match=why):
        do(world, "write", tag=tag, value=value)
    assert world.value("p.level") == 1.5
    assert world.audit() == []


def test_a_force_is_listed_with_who_and_released(world):
    do(world, "force", tag="p.count", value="16#FF")
    assert world.value("p.count") == 255
    assert world.hub.forces() == [{"path": "p.count", "value": "255", "by": "web: anna"}]
    do(world, "release", tag="p.count")
    assert world.hub.forces() == []
    assert [line["act"] for line in world.audit()] == ["force", "release"]
    texts = [(entry["source"], entry["text"]) for _, entry in world.hub.entries]
    assert texts[-2:] == [
        ("web: anna", "p.count is forced to 255"),
        ("web: anna", "p.count is released"),
    ]
    with pytest.raises(PlcError, match="not forced"):
        do(world, "release", tag="p.count")


def test_all_are_released_at_once(world):
    for tag in ("p.count", "p.small"):
        do(world, "force", tag=tag, value="1")
    do(world, "release", tag="")
    assert world.hub.forces() == []


@pytest.mark.parametrize("name", ACTS)
def test_a_role_may_do_what_it_may_and_no_more(world, name):
    for role in Role:
        if not role.includes(ACTS[name].role):
            with pytest.raises(RefusedError, match=f"the role {role.value} may not"):
                do(world, name, role, tag="p.level", value="2.0")
    assert world.value("p.level") == 1.5
    assert not world.plc.requests


@pytest.mark.parametrize(
    ("name", "argument"), [("pause", 0), ("cycles", 3), ("speed", 1_000_000), ("warm_restart", 0)]
)
def test_control_reaches_the_controller_and_is_noted(world, name, argument):
    do(world, name, argument=argument)
    (request,) = world.plc.requests
    assert (request.action.name.lower(), request.argument) == (name, argument)
    assert request.source == "web: anna"
    assert world.audit()[0]["act"] == name


def test_an_unknown_act_and_wrong_arguments(world):
    with pytest.raises(PlcError, match="no act 'fly'"):
        do(world, "fly")
    with pytest.raises(PlcError, match="whole number"):
        do(world, "cycles", argument="many")
    with pytest.raises(PlcError, match="list of at most"):
        do(world, "read", tags="p.level")


def test_values_are_read_for_scripts(world):
    found = do(world, "read", Role.LOOK, tags=["p.level", "p.mode", "p.name"])
    assert found["values"] == [1.5, "AUTO", "<b>it's</b>"]
    with pytest.raises(PlcError, match="levl"):
        do(world, "read", tags=["p.levl"])


def test_tags_that_are_gone_are_described_as_nothing(world):
    known, gone = do(world, "describe", tags=["p.mode", "p.gone"])
    assert known["names"] == ["OFF", "AUTO", "MANUAL"]
    assert gone is None
