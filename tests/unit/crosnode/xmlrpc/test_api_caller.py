"""Calls: in order for each node, never lost without a word."""

import pytest

from crosnode.xmlrpc.api_caller import MAX_WAITING, ApiCall, CallState
from plcsim.network import Outcome

from ..node.world import OTHER_IP, PLC_IP, World, end_behind_answers


def test_calls_to_one_node_are_made_in_order_over_one_connection() -> None:
    world = World()
    node, other = world.node("n"), world.node("other", OTHER_IP)
    world.until(lambda: node.is_registered and other.is_registered)
    ended: list[int] = []
    for number in range(10):
        call = ApiCall(other.uri, "getPid", ["/n"], lambda _, n=number: ended.append(n))
        node.core.api.start(call)
    world.until(lambda: len(ended) == 10, 100)
    assert ended == list(range(10))
    sources = {
        e.source for e in world.net.trace if e.source.ip == PLC_IP and e.target.ip == OTHER_IP
    }
    assert len(sources) == 1
    world.run(20)
    assert not node.core.api.is_connected(other.uri)


def test_a_node_that_is_not_there_fails_all_its_calls() -> None:
    world = World()
    node = world.node("n")
    world.net.host(OTHER_IP)
    calls = [node.call_node(f"http://{OTHER_IP}:5/", "getPid") for _ in range(3)]
    world.run(50)
    assert {call.state for call in calls} == {CallState.FAILED}
    assert "no connection" in calls[0].error
    assert not calls[0].was_answered


def test_wrong_uris_and_values_fail_their_call() -> None:
    world = World()
    node = world.node("n")
    wrong = [node.call_node(uri, "getPid") for uri in ("", "http://nowhere:5/", "x")]
    value = node.set_param("/p", object())
    large = node.set_param("/p", 1 << 40)
    world.until(lambda: node.is_registered)
    assert all(call.state is CallState.FAILED for call in [*wrong, value, large])
    assert "http" in wrong[0].error


def test_too_many_waiting_calls_fail_the_oldest() -> None:
    world = World(master=False)
    node = world.node("n")
    calls = [node.get_param("/x") for _ in range(MAX_WAITING + 5)]
    assert sum(call.state is CallState.FAILED for call in calls) >= 5
    assert "too many" in calls[0].error


def test_an_answer_of_another_form_is_the_value_itself() -> None:
    call = ApiCall("http://x:1/", "getBusStats", [])
    call.answer([[], [], []])
    assert call.value == [[], [], []]
    assert call.state is CallState.DONE
    refused = ApiCall("http://x:1/", "m", [])
    refused.answer([-1, "no", 0])
    assert (refused.state, refused.error, refused.reply) == (CallState.FAILED, "no", [-1, "no", 0])


def test_a_node_that_ends_each_connection_behind_its_answer_answers_all(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    world = World()
    node, other = world.node("n"), world.node("other", OTHER_IP)
    world.until(lambda: node.is_registered and other.is_registered)
    end_behind_answers(monkeypatch)
    calls = [node.call_node(other.uri, "getPid") for _ in range(5)]
    world.until(lambda: node.core.api.is_idle, 200)
    assert [call.state for call in calls] == [CallState.DONE] * 5


def test_a_node_that_ends_connections_without_a_word_fails_one_call_with_each() -> None:
    world = World()
    node = world.node("n")
    listener = world.net.host(OTHER_IP).open("", 5).socket
    assert listener is not None
    listener.listen(5)
    calls = [node.call_node(f"http://{OTHER_IP}:5/", "getPid") for _ in range(3)]
    states = []
    for _ in range(100):
        world.run(10)
        if (accepted := listener.accept()).outcome is Outcome.OK:
            assert accepted.socket
            world.run(10)
            states.append([call.state for call in calls])
            accepted.socket.close()
    waiting, failed = CallState.WAITING, CallState.FAILED
    assert states == [
        [waiting, waiting, waiting], [failed, waiting, waiting], [failed, failed, waiting],
    ]  # fmt: skip
    assert {call.state for call in calls} == {failed}


def test_a_node_that_does_not_answer_in_time_fails_all() -> None:
    world = World()
    node = world.node("n")
    listener = world.net.host(OTHER_IP).open("", 5).socket
    assert listener is not None
    listener.listen(5)
    calls = [node.call_node(f"http://{OTHER_IP}:5/", "getPid") for _ in range(3)]
    world.run(10_200, step_ms=10)
    assert {call.error for call in calls} == {"silent for 10000000000 ns"}
