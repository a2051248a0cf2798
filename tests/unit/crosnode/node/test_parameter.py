from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import MessageValueError
from crosnode.node import ParameterUpdate, StatusKind
from crosnode.node.parameter import ParameterSubscription, check_parameters
from crosnode.node.registration import Registration, RegistrationState
from crosnode.xmlrpc import ValueLimits, XmlRpcLimits

from .world import OTHER_IP, PLC_IP, World, drain, news


def subscription(name: str = "/p") -> ParameterSubscription:
    return ParameterSubscription(name, Registration(name, ("", []), ("", [])), queue_size=3)


def test_a_subscriber_hears_the_value_and_every_change() -> None:
    world = World()
    node, setter = world.node("n"), world.node("setter", OTHER_IP)
    setter.set_param("/p", 1)
    world.until(lambda: setter.core.api.is_idle and setter.is_registered)
    param = node.subscribe_param("/p")
    world.until(lambda: param.value == 1)
    setter.set_param("/p", "two")
    world.until(lambda: param.value == "two")
    setter.delete_param("/p")
    world.until(lambda: param.value == {})
    assert drain(param.pop) == [
        ParameterUpdate("/p", 1),
        ParameterUpdate("/p", "two"),
        ParameterUpdate("/p", {}),
    ]
    assert len(news(node, StatusKind.PARAM_UPDATE)) == 2


def test_a_leaf_changes_only_its_place_in_the_namespace() -> None:
    world = World()
    node, setter = world.node("n"), world.node("setter", OTHER_IP)
    param, prefix = node.subscribe_param("/p"), node.subscribe_param("/po")
    setter.set_param("/p", {"a": {"b": 1}, "c": 2})
    setter.set_param("/p/a/b", 5)
    setter.set_param("/p/d/e", 6)
    setter.set_param("/pother", 7)
    world.until(lambda: isinstance(param.value, dict) and "d" in param.value)
    world.run(20)
    assert param.value == {"a": {"b": 5}, "c": 2, "d": {"e": 6}}
    assert prefix.value == {}


def test_changes_that_overtake_the_answer_to_the_registration_are_made_again() -> None:
    param = subscription()
    param.registration.state = RegistrationState.CALLING
    param.param_update("/p/a", 2)
    param.param_update("/p/b", 3)
    param.registered({"a": 1, "c": 4})
    assert param.value == {"a": 2, "b": 3, "c": 4}


def test_two_subscriptions_of_one_name_both_hear() -> None:
    world = World()
    node, setter = world.node("n"), world.node("setter", OTHER_IP)
    one, two = node.subscribe_param("/p"), node.subscribe_param("/p")
    world.until(lambda: node.is_registered)
    setter.set_param("/p", 3)
    world.until(lambda: one.value == 3 and two.value == 3)


def test_after_unsubscribing_nothing_comes() -> None:
    world = World()
    node, setter = world.node("n"), world.node("setter", OTHER_IP)
    param = node.subscribe_param("/p")
    world.until(lambda: node.is_registered)
    node.unregister(param)
    world.run(20)
    setter.set_param("/p", 3)
    world.run(30)
    assert param.value == {}


def test_deleting_a_leaf_takes_it_out() -> None:
    param = subscription()
    param.set_all({"a": 1, "b": {"c": 2}})
    param.update("/p/b/c/", {})
    assert param.value == {"a": 1, "b": {}}


def test_the_value_handed_out_before_does_not_change() -> None:
    param = subscription()
    param.set_all({"a": {"b": 1}})
    before = param.value
    param.update("/p/a/b", 2)
    assert before == {"a": {"b": 1}}
    assert param.value == {"a": {"b": 2}}


names = st.lists(st.sampled_from("abc"), min_size=1, max_size=3)


@given(st.lists(st.tuples(names, st.integers())))
def test_updates_build_the_tree_that_a_dict_would(updates: list[tuple[list[str], int]]) -> None:
    param, model = subscription(), {}
    for path, value in updates:
        param.update("/p/" + "/".join(path), value)
        place: dict[str, Any] = model
        for step in path[:-1]:
            if not isinstance(place.get(step), dict):
                place[step] = {}
            place = place[step]
        place[path[-1]] = value
    assert param.value == model
    assert len(param.updates) <= 3


def test_what_the_own_node_sets_reaches_its_subscriptions() -> None:
    world = World()
    node = world.node("n")
    leaf, space = node.subscribe_param("/arm/speed"), node.subscribe_param("/arm")
    world.until(lambda: node.is_registered)
    world.run(20)
    node.set_param("/arm/speed", 5)
    world.run(20)
    assert (leaf.value, space.value) == (5, {"speed": 5})
    node.set_param("/arm", {"speed": 7, "name": "left"})
    world.run(20)
    assert (leaf.value, space.value) == (7, {"speed": 7, "name": "left"})
    node.set_param("/arm", 1)
    world.run(20)
    assert (leaf.value, space.value) == ({}, 1)
    node.set_param("/arm/speed", 2)
    node.delete_param("/arm")
    world.run(20)
    assert (leaf.value, space.value) == ({}, {})
    node.set_param("/armchair", 3)
    world.run(20)
    assert (leaf.value, space.value) == ({}, {})


@pytest.mark.parametrize("value", [3_000_000_000, [None], {"a": 1.0, "b": None}])
def test_a_value_that_xml_rpc_cannot_carry(value: object) -> None:
    with pytest.raises(MessageValueError, match=r"parameter p: XML-RPC cannot carry"):
        check_parameters({"p": value})


def test_a_node_with_such_an_argument_opens_nothing() -> None:
    world = World()
    with pytest.raises(MessageValueError, match="parameter /n/p: "):
        world.node("n", PLC_IP, "_p:=3000000000")


def test_a_parameter_beyond_the_limit_is_refused_once() -> None:
    world = World()
    limits = XmlRpcLimits(values=ValueLimits(max_size=2_000))
    node, other = world.node("n", xmlrpc=limits), world.node("other", OTHER_IP)
    other.set_param("/much", "x" * 3_000)
    world.run(50)
    param = node.subscribe_param("/much")
    publisher = node.register_publisher("/x", "std_msgs/String")
    world.run(10_000)
    (refused,) = news(node, StatusKind.REGISTRATION_REFUSED)
    assert refused.name == "/much"
    assert "more than 2000 bytes" in refused.text
    assert param.value == {}
    assert publisher.registration.state is RegistrationState.REGISTERED


def test_an_update_beyond_the_limit_is_told_once_and_the_others_go_on() -> None:
    world = World()
    limits = XmlRpcLimits(values=ValueLimits(max_size=2_000))
    node, other = world.node("n", xmlrpc=limits), world.node("other", OTHER_IP)
    much, little = node.subscribe_param("/much"), node.subscribe_param("/little")
    world.until(lambda: little.registration.state is RegistrationState.REGISTERED)
    other.set_param("/much", "x" * 3_000)
    world.run(5_000)
    other.set_param("/little", 5)
    world.run(5_000)
    (refused,) = news(node, StatusKind.PEER_REFUSED)
    assert "more than 2000 bytes" in refused.text
    assert (much.value, little.value) == ({}, 5)


def test_an_update_beyond_the_limit_takes_none_of_its_burst_with_it() -> None:
    world = World()
    limits = XmlRpcLimits(values=ValueLimits(max_size=2_000))
    node, other = world.node("n", xmlrpc=limits), world.node("other", OTHER_IP)
    much, little = node.subscribe_param("/much"), node.subscribe_param("/little")
    world.until(lambda: little.registration.state is RegistrationState.REGISTERED)
    world.run(50)
    for number in range(3):
        other.set_param("/much", "x" * 3_000)
        other.set_param("/little", number)
    world.until(lambda: little.value == 2, 500)
    assert much.value == {}
    assert len(news(node, StatusKind.PEER_REFUSED)) == 3
