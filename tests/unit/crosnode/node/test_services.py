"""Service providers and callers."""

import struct

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from crosnode.errors import MessageValueError
from crosnode.node import CrosNode, ServiceCaller, ServiceProvider, StatusKind
from crosnode.tcpros.header import encode_header
from plcsim.network import Address, Outcome

from .world import MS, OTHER_IP, PLC_IP, World, drain, news

SET_BOOL = "std_srvs/SetBool"
CALLER = {"callerid": "/raw", "service": "/set", "md5sum": "*"}


class Service:
    """A provider and a caller; the program of the provider answers what it is asked."""

    def __init__(self, *, persistent: bool = False, queue_size: int = 10) -> None:
        self.world = World()
        self.server: CrosNode = self.world.node("server")
        self.client = self.world.node("client", OTHER_IP)
        self.provider: ServiceProvider = self.server.register_service_provider("/set", SET_BOOL)
        self.caller: ServiceCaller = self.client.register_service_caller(
            "/set", SET_BOOL, persistent=persistent, queue_size=queue_size
        )
        self.answers = True
        self.world.until(lambda: self.server.is_registered)
        self.world.steps.append(self.answer)

    def answer(self) -> None:
        while self.answers and (request := self.provider.pop()) is not None:
            if request.request.data:  # type: ignore[attr-defined]
                request.respond(success=True, message="done")
            else:
                request.fail("I will not")

    def call(self, data: bool = True) -> None:
        self.caller.call(self.caller.new(data=data))


def results(caller: ServiceCaller) -> list[str]:
    return [
        reply.error or reply.response.message  # type: ignore[union-attr,attr-defined]
        for reply in drain(caller.pop)
    ]


@pytest.mark.parametrize("persistent", [True, False])
def test_calls_are_answered_in_order(persistent: bool) -> None:
    service = Service(persistent=persistent)
    for data in (True, False, True):
        service.call(data)
    service.world.until(lambda: len(service.caller.replies) == 3)
    assert results(service.caller) == ["done", "I will not", "done"]
    assert service.caller.is_idle


def test_only_a_persistent_connection_is_kept() -> None:
    for persistent, expected in ((True, 1), (False, 3)):
        service = Service(persistent=persistent)
        for _ in range(3):
            service.call()
        service.world.until(lambda s=service: len(s.caller.replies) == 3)
        provider = Address(PLC_IP, service.server._service_listener.port)
        opened = {e.source for e in service.world.net.trace if e.target == provider}
        assert len(opened) == expected


def test_a_service_that_nobody_provides_is_an_error_for_the_program() -> None:
    world = World()
    caller = world.node("client").register_service_caller("/none", SET_BOOL)
    caller.call(caller.new())
    world.until(lambda: caller.replies)
    assert "no provider of /none" in results(caller)[0]
    world.kill_master()
    caller.call(caller.new())
    world.until(lambda: caller.replies)
    assert results(caller)[0]


def test_the_uri_may_end_in_a_slash_or_not() -> None:
    service = Service()
    uri = f"rosrpc://{PLC_IP}:{service.server._service_listener.port}"
    for form in (uri, uri + "/"):
        other = service.world.node("x", "192.168.0.30")
        other.call_master("registerService", "/other", form, other.uri)
        caller = service.client.register_service_caller("/other", SET_BOOL)
        service.world.run(20)
        caller.call(caller.new())
        service.world.until(lambda c=caller: c.replies)
        assert "does not provide /other" in results(caller)[0]


def test_an_empty_response_arrives() -> None:
    world = World()
    server, client = world.node("server"), world.node("client", OTHER_IP)
    provider = server.register_service_provider("/e", "std_srvs/Empty")
    world.until(lambda: server.is_registered)
    caller = client.register_service_caller("/e", "std_srvs/Empty")
    caller.call(caller.new())
    world.until(lambda: (request := provider.pop()) and (request.respond(), True))
    world.until(lambda: caller.replies)
    assert drain(caller.pop)[0].error == ""


def test_an_answer_may_come_in_a_later_cycle() -> None:
    service = Service()
    service.answers = False
    service.call()
    service.world.run(500)
    assert not service.caller.replies
    service.answers = True
    service.world.until(lambda: service.caller.replies)
    assert results(service.caller) == ["done"]


def test_a_caller_that_went_away_harms_nobody() -> None:
    service = Service()
    service.answers = False
    service.call()
    service.world.run(50)
    request = service.provider.pop()
    assert request
    service.client.unregister(service.caller)
    service.world.run(10)
    request.respond(success=True)
    request.respond(success=True)
    service.world.run(10)
    assert not service.server.is_shut_down


def test_too_many_waiting_requests_are_refused() -> None:
    world = World()
    server = world.node("server")
    provider = server.register_service_provider("/set", SET_BOOL, queue_size=2)
    body = struct.pack("<I", 1) + b"\x01"
    sockets = [
        world.dial(PLC_IP, server._service_listener.port, encode_header(CALLER) + body)
        for _ in range(3)
    ]
    answers = [world.receive(socket, 20) for socket in sockets]
    assert [b"too many requests wait" in answer for answer in answers].count(True) == 1
    assert provider.requests == 3


def test_a_wrong_value_in_a_response_leaves_the_request_open() -> None:
    service = Service()
    service.answers = False
    service.call()
    service.world.run(50)
    request = service.provider.pop()
    assert request
    with pytest.raises(MessageValueError, match="message"):
        request.respond(message=3)
    request.respond(message="better")
    service.world.until(lambda: service.caller.replies)
    assert results(service.caller) == ["better"]


def test_a_probe_gets_the_header_and_no_call() -> None:
    service = Service()
    port = service.server._service_listener.port
    socket = service.world.dial(PLC_IP, port, encode_header(CALLER | {"probe": "1"}))
    answer = service.world.receive(socket)
    assert b"type=std_srvs/SetBool" in answer
    assert b"request_type=std_srvs/SetBoolRequest" in answer
    assert socket.recv(1).outcome is Outcome.CLOSED


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"md5sum": "0" * 32}, b"does not match"),
        ({"service": "/none"}, b"does not provide /none"),
    ],
)
def test_a_caller_that_does_not_fit_is_told_why(fields: dict[str, str], reason: bytes) -> None:
    service = Service()
    port = service.server._service_listener.port
    socket = service.world.dial(PLC_IP, port, encode_header(CALLER | fields))
    assert reason in service.world.receive(socket)


def test_a_request_that_is_no_message_is_answered_and_ends_its_connection() -> None:
    service = Service()
    port = service.server._service_listener.port
    hostile = encode_header(CALLER | {"persistent": "1"}) + struct.pack("<I", 3) + b"abc"
    socket = service.world.dial(PLC_IP, port, hostile)
    answer = service.world.receive(socket)
    assert b"std_srvs/SetBoolRequest" in answer
    assert socket.recv(1).outcome is Outcome.CLOSED
    assert news(service.server, StatusKind.BAD_MESSAGE)


def test_a_request_is_asked_for_once_a_period() -> None:
    service = Service()
    caller = service.client.register_service_caller("/set", SET_BOOL, loop_period_ns=100 * MS)
    got = 0
    for _ in range(450):
        if (request := caller.pop_packet()) is not None:
            request.data = True  # type: ignore[attr-defined]
            caller.call(request)
        service.world.run(1)
        got += len(results(caller))
    assert got in (4, 5)


def test_a_provider_that_dies_fails_the_call() -> None:
    service = Service(persistent=True)
    service.answers = False
    service.call()
    service.world.until(lambda: service.provider.requests)
    service.world.faults.reset(PLC_IP, OTHER_IP)
    service.world.until(lambda: service.caller.replies)
    assert results(service.caller)[0]


def test_a_provider_that_never_answers_fails_the_call_in_time() -> None:
    service = Service()
    service.answers = False
    service.call()
    service.world.until(lambda: service.caller.replies, 11_000)
    assert "silent" in results(service.caller)[0]


@settings(max_examples=40, deadline=None)
@given(st.binary(max_size=200), st.booleans())
def test_any_bytes_end_at_most_their_own_connection(data: bytes, greeted: bool) -> None:
    service = Service()
    port = service.server._service_listener.port
    hello = encode_header(CALLER | {"persistent": "1"}) if greeted else b""
    socket = service.world.dial(PLC_IP, port, hello + data)
    service.world.receive(socket, 10)
    service.call()
    service.world.until(lambda: service.caller.replies)
    assert results(service.caller) == ["done"]


def test_a_call_too_many_fails_in_its_turn() -> None:
    """Each call has its reply, in order, so a program can tell which is which."""
    service = Service(queue_size=3)
    caller = service.caller
    service.answers = False
    service.call()
    service.world.until(lambda: service.provider.requests)
    for _ in range(4):
        service.call()
    assert caller.requests.dropped == 1
    assert not caller.replies
    service.answers = True
    service.world.until(lambda: len(caller.replies) == 2)
    assert results(caller) == ["done", "too many calls wait"]
    service.world.until(lambda: len(caller.replies) == 3)
    assert results(caller) == ["done", "done", "done"]


def test_calls_too_many_before_the_first_step_fail_at_once() -> None:
    service = Service(queue_size=2)
    for _ in range(3):
        service.call()
    assert results(service.caller) == ["too many calls wait"]
    service.world.until(lambda: len(service.caller.replies) == 2)
    assert results(service.caller) == ["done", "done"]
