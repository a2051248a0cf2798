"""Requests to the master: replies, and the calls they cause."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.master.master import MASTER_NAME, METHODS, Master, MasterLimits, OutgoingCall
from crosnode.xmlrpc import MethodCall, MethodFault, MethodResponse, check_value

TALKER, LISTENER = "http://h:1/", "http://h:2/"
STRING = "std_msgs/String"


def master() -> Master:
    return Master("http://m:11311/", 42)


def ask(to: Master, method: str, *params: object) -> Any:
    reply = to.handle(MethodCall(method, list(params))).reply
    assert isinstance(reply, MethodResponse)
    return reply.value


def calls(to: Master, method: str, *params: object) -> list[OutgoingCall]:
    return to.handle(MethodCall(method, list(params))).calls


def update(uri: str, topic: str, publishers: list[str]) -> OutgoingCall:
    return OutgoingCall(uri, "publisherUpdate", [MASTER_NAME, topic, publishers])


def test_publisher_then_subscriber() -> None:
    m = master()
    assert ask(m, "registerPublisher", "/talker", "/chatter", STRING, TALKER) == [
        1, "Registered [/talker] as publisher of [/chatter]", [],
    ]  # fmt: skip
    assert ask(m, "registerSubscriber", "/listener", "/chatter", STRING, LISTENER) == [
        1, "Subscribed to [/chatter]", [TALKER],
    ]  # fmt: skip
    assert ask(m, "getSystemState", "/x")[2] == [
        [["/chatter", ["/talker"]]],
        [["/chatter", ["/listener"]]],
        [],
    ]
    assert ask(m, "getPublishedTopics", "/x", "") == [1, "current topics", [["/chatter", STRING]]]
    assert ask(m, "getTopicTypes", "/x")[2] == [["/chatter", STRING]]


def test_subscriber_is_told_of_publishers_coming_and_going() -> None:
    m = master()
    ask(m, "registerSubscriber", "/listener", "/chatter", "*", LISTENER)
    coming = calls(m, "registerPublisher", "/talker", "/chatter", STRING, TALKER)
    assert coming == [update(LISTENER, "/chatter", [TALKER])]
    going = calls(m, "unregisterPublisher", "/talker", "/chatter", TALKER)
    assert going == [update(LISTENER, "/chatter", [])]
    assert calls(m, "unregisterPublisher", "/talker", "/chatter", TALKER) == []
    assert ask(m, "unregisterSubscriber", "/listener", "/chatter", LISTENER)[2] == 1
    assert ask(m, "unregisterSubscriber", "/listener", "/chatter", LISTENER)[2] == 0


def test_names_are_resolved_in_the_namespace_of_the_caller() -> None:
    m = master()
    ask(m, "registerPublisher", "/ns/talker", "chatter", STRING, TALKER)
    ask(m, "registerPublisher", "/ns/talker", "~own", STRING, TALKER)
    assert ask(m, "getPublishedTopics", "/ns/x", "")[2] == [
        ["/ns/chatter", STRING],
        ["/ns/talker/own", STRING],
    ]
    assert ask(m, "getPublishedTopics", "/ns/x", "talker")[2] == [["/ns/talker/own", STRING]]
    assert ask(m, "getPublishedTopics", "/x", "/n")[2] == []


def test_services() -> None:
    m = master()
    assert ask(m, "lookupService", "/x", "/add") == [-1, "no provider", ""]
    assert ask(m, "registerService", "/p", "/add", "rosrpc://h:9", TALKER)[::2] == [1, 1]
    assert ask(m, "lookupService", "/x", "add") == [1, "rosrpc URI: [rosrpc://h:9]", "rosrpc://h:9"]
    assert ask(m, "unregisterService", "/p", "/add", "rosrpc://h:8")[::2] == [1, 0]
    assert ask(m, "unregisterService", "/p", "/add", "rosrpc://h:9/")[::2] == [1, 1]
    assert ask(m, "getSystemState", "/x")[2][2] == []


def test_lookup_node() -> None:
    m = master()
    ask(m, "registerPublisher", "/talker", "/chatter", STRING, TALKER)
    assert ask(m, "lookupNode", "/x", "/talker") == [1, "node api", TALKER]
    assert ask(m, "lookupNode", "/x", "/none") == [-1, "unknown node [/none]", ""]


def test_second_node_of_a_name_shuts_the_first_down() -> None:
    m = master()
    ask(m, "registerPublisher", "/talker", "/chatter", STRING, TALKER)
    (call,) = calls(m, "registerPublisher", "/talker", "/other", STRING, LISTENER)
    reason = "[/talker] Reason: new node registered with same name"
    assert call == OutgoingCall(TALKER, "shutdown", [MASTER_NAME, reason])
    assert ask(m, "getSystemState", "/x")[2][0] == [["/other", ["/talker"]]]


def test_the_subscribers_of_a_node_that_lost_its_name_are_told() -> None:
    """Else they would dial the old address for ever: the node itself is not known any more."""
    m = master()
    ask(m, "registerSubscriber", "/listener", "/chatter", STRING, LISTENER)
    ask(m, "registerPublisher", "/talker", "/chatter", STRING, TALKER)
    shutdown, *rest = calls(m, "registerPublisher", "/talker", "/other", STRING, "http://h:3/")
    assert (shutdown.uri, shutdown.method) == (TALKER, "shutdown")
    assert rest == [update(LISTENER, "/chatter", [])]


def test_master_itself() -> None:
    m = master()
    assert ask(m, "getUri", "/x") == [1, "", "http://m:11311/"]
    assert ask(m, "getPid", "/x") == [1, "", 42]
    assert not m.is_shut_down
    assert ask(m, "shutdown", "/x", "bye") == [1, "shutdown", 0]
    assert m.is_shut_down


def test_parameters() -> None:
    m = Master("http://m:11311/", 42, {"/run_id": "abc"})
    assert ask(m, "getParam", "/ns/n", "/run_id")[::2] == [1, "abc"]
    assert ask(m, "setParam", "/ns/n", "rate", 10) == [1, "parameter /ns/rate set", 0]
    assert ask(m, "setParam", "/ns/n", "~gain", 2.5)[0] == 1
    assert ask(m, "setParam", "/ns/n", "/1-odd/name", True)[0] == 1
    assert ask(m, "getParam", "/x", "/ns")[2] == {"rate": 10, "n": {"gain": 2.5}}
    assert ask(m, "hasParam", "/x", "/1-odd") == [1, "/1-odd", True]
    assert ask(m, "hasParam", "/x", "none") == [1, "/none", False]
    assert ask(m, "searchParam", "/ns/n", "rate") == [1, "Found [/ns/rate]", "/ns/rate"]
    assert ask(m, "searchParam", "/ns/n", "none")[::2] == [-1, ""]
    assert ask(m, "getParamNames", "/x")[2] == ["/run_id", "/ns/rate", "/ns/n/gain", "/1-odd/name"]
    assert ask(m, "deleteParam", "/x", "/ns") == [1, "parameter /ns deleted", 0]
    assert ask(m, "deleteParam", "/x", "/ns") == [-1, "parameter [/ns] is not set", 0]
    assert ask(m, "getParam", "/x", "/ns") == [-1, "Parameter [/ns] is not set", 0]


def param_update(uri: str, key: str, value: object) -> OutgoingCall:
    return OutgoingCall(uri, "paramUpdate", [MASTER_NAME, key, value])


def test_watchers_are_told_but_not_who_set() -> None:
    m = master()
    assert ask(m, "subscribeParam", "/a", TALKER, "/p")[::2] == [1, {}]
    ask(m, "subscribeParam", "/b", LISTENER, "/p")
    assert calls(m, "setParam", "/a", "/p", 1) == [param_update(LISTENER, "/p/", 1)]
    assert ask(m, "subscribeParam", "/a", TALKER, "/p")[2] == 1
    assert calls(m, "setParam", "/c", "/pother", 1) == []
    assert [call.uri for call in calls(m, "deleteParam", "/a", "/p")] == [TALKER, LISTENER]
    assert ask(m, "unsubscribeParam", "/a", TALKER, "/p")[2] == 1
    assert ask(m, "unsubscribeParam", "/a", TALKER, "/p")[2] == 0
    assert calls(m, "setParam", "/c", "/p/q", 2) == [param_update(LISTENER, "/p/q/", 2)]
    assert calls(m, "setParam", "/b", "/", {"p": {"q": 3}, "x": 1}) == [
        param_update(LISTENER, "/p/", {"q": 3})
    ]


def test_watcher_that_refuses_is_forgotten() -> None:
    m = master()
    ask(m, "subscribeParam", "/a", TALKER, "/p")
    (call,) = calls(m, "setParam", "/c", "/p", 1)
    m.handle_reply(call, [1, "", 0])
    m.handle_reply(call, "nonsense")
    assert calls(m, "setParam", "/c", "/p", 1) == [call]
    m.handle_reply(call, [-1, "not subscribed", 0])
    assert calls(m, "setParam", "/c", "/p", 1) == []


def test_calls_carry_the_value_of_their_time() -> None:
    m = master()
    ask(m, "subscribeParam", "/a", TALKER, "/p")
    (call,) = calls(m, "setParam", "/c", "/p", {"q": [1]})
    ask(m, "setParam", "/c", "/p/q", [2])
    assert call.params[2] == {"q": [1]}


def test_multicall() -> None:
    m = master()
    ask(m, "registerSubscriber", "/l", "/chatter", STRING, LISTENER)
    ask(m, "registerPublisher", "/t", "/chatter", STRING, TALKER)
    entries = [
        {"methodName": "unregisterPublisher", "params": ["/t", "/chatter", TALKER]},
        {"methodName": "nonsense", "params": []},
        {"methodName": "getPid", "params": ["/t"]},
    ]
    answer = m.handle(MethodCall("system.multicall", [entries]))
    assert answer.calls == [update(LISTENER, "/chatter", [])]
    assert isinstance(answer.reply, MethodResponse)
    first, second, third = answer.reply.value
    assert first[0][::2] == [1, 1]
    assert second["faultCode"] == 1
    assert third == [[1, "", 42]]


@pytest.mark.parametrize(
    ("method", "params", "reply"),
    [
        ("getPid", [], [-1, -1]),
        ("getPid", [5], [-1, -1]),
        ("getPid", ["x" * 2000], [-1, -1]),
        ("getPid", ["/x", 1], [-1, -1]),
        ("getParam", ["/x"], [-1, 0]),
        ("getParam", ["/x", ""], [-1, 0]),
        ("getParam", ["/x", 7], [-1, 0]),
        ("registerPublisher", ["/x", "/t", "nonsense", TALKER], [-1, []]),
        ("registerPublisher", ["/x", "/t", STRING, "nonsense"], [-1, []]),
        ("registerPublisher", ["/x", "/", STRING, TALKER], [-1, []]),
        ("registerPublisher", ["/x", "http://h:1", STRING, TALKER], [-1, []]),
        ("registerPublisher", ["/x", "/" + "t" * 2000, STRING, TALKER], [-1, []]),
        ("registerService", ["/x", "/s", TALKER, TALKER], [-1, 0]),
        ("setParam", ["/x", "/", 5], [-1, 0]),
        ("setParam", ["/x", "/p", 2**40], [-1, 0]),
        ("setParam", ["/x", "/p" * 60, 1], [0, 0]),
        ("lookupNode", ["/x", None], [-1, ""]),
    ],
)
def test_bad_requests(method: str, params: list[object], reply: list[object]) -> None:
    code, message, value = ask(master(), method, *params)
    assert [code, value] == reply
    assert isinstance(message, str)


def test_unknown_method() -> None:
    assert master().handle(MethodCall("nonsense", [])).reply == MethodFault(
        1, "method 'nonsense' is not supported"
    )


def test_list_methods() -> None:
    assert set(ask(master(), "system.listMethods")) > set(METHODS)


def test_limits() -> None:
    m = Master("http://m:1/", 1, limits=MasterLimits(max_registrations=1, max_parameters=100))
    ask(m, "registerPublisher", "/a", "/t", STRING, TALKER)
    assert ask(m, "registerPublisher", "/a", "/u", STRING, TALKER)[::2] == [0, []]
    assert ask(m, "setParam", "/a", "/p", "x" * 100)[::2] == [0, 0]


ANYTHING = st.recursive(
    st.sampled_from(["/a", "a", "~a", "", TALKER, "rosrpc://h:1", STRING, "/"])
    | st.integers(-(2**31), 2**31 - 1)
    | st.booleans(),
    lambda inner: st.lists(inner, max_size=2) | st.dictionaries(st.text("ab/"), inner, max_size=2),
    max_leaves=3,
)


@given(st.lists(st.tuples(st.sampled_from(sorted(METHODS)), st.lists(ANYTHING, max_size=4))))
def test_any_requests(requests: list[tuple[str, list[object]]]) -> None:
    m = master()
    for method, params in requests:
        answer = m.handle(MethodCall(method, params))
        assert isinstance(answer.reply, MethodResponse)
        code, message, _ = answer.reply.value
        assert code in (-1, 0, 1)
        assert isinstance(message, str)
        check_value(answer.reply.value)
        for call in answer.calls:
            check_value(call.params)
