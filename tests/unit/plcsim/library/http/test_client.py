"""httpClient against a server on a virtual net."""

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.http import statuses
from plcsim.library.http.client import LIMIT_NS
from plcsim.library.members import BlockVariables, StructMembers
from plcsim.library.models import modelled_block
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE
from plcsim.network import VirtualNetwork
from plcsim.network.protocol import Outcome
from st_types import BOOL, DATE_AND_TIME, UDINT, UINT
from st_types.types.derived import (
    ArrayType,
    DataBlockType,
    Member,
    Section,
    StringType,
    StructType,
)

SERVER, CLIENT = "192.168.0.10", "192.168.0.20"
MS = 1_000_000

LINE = StructType(
    "httpHeaderLine_t", [Member("name", StringType(50)), Member("value", StringType(80))]
)
RAW = StructType(
    "httpRawHeader_t", [Member(name, UDINT) for name in ("pData", "dataSize", "dataLen")]
)
FIELDS = [
    Member("contentType", StringType(100)),
    Member("contentLength", UDINT),
    Member("connection", StringType(80)),
    Member("keepAlive", StringType(80)),
    Member("userLine", ArrayType(LINE, [(0, 1)])),
    Member("rawHeader", RAW),
]
REQUEST = StructType(
    "httpRequestHeader_t",
    [Member("protocol", StringType(20)), Member("host", StringType(280)), *FIELDS],
)
RESPONSE = StructType(
    "httpResponseHeader_t",
    [Member("protocol", StringType(20)), Member("status", StringType(280)), *FIELDS],
)
STATISTICS = StructType(
    "httpStatistics_t",
    [
        Member("requestCounter", UDINT),
        Member("timeOfLastRequest", DATE_AND_TIME),
        Member("responseCounter", UDINT),
        Member("errorCounter", UDINT),
        Member("lastError", UDINT),
    ],
)
ADDRESSES = "pHost pUri pRequestHeader pRequestData pResponseHeader pResponseData pStatistics"
NUMBERS = f"option method requestDataLen responseDataSize {ADDRESSES}".split()
INPUTS = {"enable": BOOL, "send": BOOL, "abort": BOOL, "hostPort": UINT}
INPUTS |= dict.fromkeys(NUMBERS, UDINT)
OUTPUTS = dict.fromkeys(("status", "httpStatus", "phase"), UINT) | {"responseDataLen": UDINT}
ANSWER = b"HTTP/1.1 200 OK\r\nContent-Type: text/plain\r\nETag: 7\r\nContent-Length: 4\r\n\r\ngood"


class World:
    """A controller with a client, and a server beside it."""

    def __init__(self, name):
        self.now_ns = 0
        net = VirtualNetwork(lambda: self.now_ns, call_ns=0)
        self.memory = Memory()
        self.context = Context(self.memory, net.host(CLIENT))
        self.listener = net.host(SERVER).open("", 80).socket
        assert self.listener.listen(1) is Outcome.OK
        members = [Member(each, kind, section=Section.INPUT) for each, kind in INPUTS.items()]
        members += [Member(each, kind, section=Section.OUTPUT) for each, kind in OUTPUTS.items()]
        data_type = DataBlockType(name, members)
        self.block = self.structure(data_type)
        types = {each.name: each for each in (LINE, REQUEST, RESPONSE, STATISTICS)}
        self._run = modelled_block(data_type, types.get).bind(self.context)
        self.room = self.memory.allocate(64)
        self.block.set(
            enable=True,
            pHost=self.text(SERVER),
            hostPort=80,
            method=1,
            pUri=self.text("/state?n=1 2"),
            pResponseData=self.room,
            responseDataSize=64,
        )

    def structure(self, data_type):
        address = self.memory.allocate(data_type.size)
        return BlockVariables(self.memory, StructMembers(data_type), address)

    def text(self, text):
        address = self.memory.allocate(len(text) + 1)
        self.memory.write(address, text.encode("latin-1") + b"\0")
        return address

    def call(self, **inputs):
        """Call the client once; its status and phase."""
        self.block.set(**inputs)
        self._run(self.block.start)
        return self.block.number("status"), self.block.number("phase")

    def run(self, cycles=5):
        """Let time go on, 1 ms in each call; status and phase of the last."""
        for _ in range(cycles):
            self.now_ns += MS
            self.context.release_ns = self.now_ns
            found = self.call()
        return found

    def asked(self):
        """Send a request; the server's socket, and what it has received."""
        assert self.call(send=True)[0] == ERR_FUB_BUSY
        assert self.run() == (ERR_FUB_BUSY, statuses.RECEIVING)
        self.call(send=False)
        socket = self.listener.accept().socket
        return socket, socket.recv(10_000).data

    def exchange(self, answer, *, close=False):
        """Send a request that is answered; status and phase, and the request."""
        socket, request = self.asked()
        assert socket.send(answer).outcome is Outcome.OK
        if close:
            socket.close()
        return self.run(), request


@pytest.fixture
def world():
    return World("httpClient")


def test_a_request_and_its_response(world):
    assert world.call() == (0, statuses.NOT_CONNECTED)
    end, request = world.exchange(ANSWER)
    assert end == (0, statuses.RECEIVED)
    assert request == (
        b"GET /state?n=1%202 HTTP/1.0\r\nHost: 192.168.0.10\r\n"
        b"Content-Length: 0\r\nConnection: close\r\n\r\n"
    )
    assert (world.block.number("httpStatus"), world.block.number("responseDataLen")) == (200, 4)
    assert world.memory.read(world.room, 5) == b"good\0"
    assert world.call() == (0, statuses.RECEIVED)
    end, request = world.exchange(ANSWER.replace(b"200", b"404"))
    assert (end, world.block.number("httpStatus")) == ((0, statuses.RECEIVED), 404)


def test_a_response_that_ends_with_its_connection(world):
    end, _ = world.exchange(b"HTTP/1.0 200 OK\r\n\r\nall", close=True)
    assert (end, world.memory.read(world.room, 3)) == ((0, statuses.RECEIVED), b"all")


def test_headers_and_data_of_a_request(world):
    header = world.structure(REQUEST)
    header.set(host="robot", contentType="application/json")
    raw = world.text("Cookie: a=b")
    header.set(rawHeader__pData=raw, rawHeader__dataLen=11)
    for index, (name, value) in enumerate([("Accept", "*/*"), ("content-length", "99")]):
        at = header.element_address("userLine", index)
        BlockVariables(world.memory, StructMembers(LINE), at).set(name=name, value=value)
    world.block.set(option=1, method=2, pRequestHeader=header.start)
    world.block.set(pRequestData=world.text("{}"), requestDataLen=2)
    _, request = world.exchange(ANSWER)
    assert request == (
        b"POST /state?n=1%202 HTTP/1.1\r\nHost: robot\r\nContent-Length: 2\r\n"
        b"Connection: close\r\nContent-Type: application/json\r\nAccept: */*\r\n"
        b"Cookie: a=b\r\n\r\n{}"
    )


def test_the_header_of_a_response(world):
    header = world.structure(RESPONSE)
    raw = world.memory.allocate(40)
    header.set(rawHeader__pData=raw, rawHeader__dataSize=30)
    line = BlockVariables(world.memory, StructMembers(LINE), header.element_address("userLine", 1))
    line.set(name="Etag")
    world.block.set(pResponseHeader=header.start)
    world.exchange(ANSWER)
    assert header.own_text("protocol") == "HTTP/1.1"
    assert header.own_text("status") == "200 OK"
    assert header.own_text("contentType") == "text/plain"
    assert header.number("contentLength") == 4
    assert line.own_text("value") == "7"
    assert header.number("rawHeader.dataLen") == 29
    assert world.memory.read(raw, 30) == b"Content-Type: text/plain\r\nETa\0"[:29] + b"\0"


def test_statistics(world):
    statistics = world.structure(STATISTICS)
    world.block.set(pStatistics=statistics.start)
    world.exchange(ANSWER)
    world.call(send=True, method=9)
    counted = ("requestCounter", "responseCounter", "errorCounter", "lastError")
    assert [statistics.number(name) for name in counted] == [1, 1, 1, 35556]


@pytest.mark.parametrize(
    ("inputs", "status"),
    [
        ({"pHost": 0}, statuses.INVALID_PARAM),
        ({"pUri": 0}, statuses.INVALID_PARAM),
        ({"method": 0}, statuses.METHOD_UNSUPPORTED),
        ({"hostPort": 0}, statuses.CLIENT_TCP_INVALID_HOST),
    ],
)
def test_a_request_that_is_refused(world, inputs, status):
    assert world.call(send=True, **inputs) == (status, statuses.NOT_CONNECTED)
    assert world.run() == (status, statuses.NOT_CONNECTED)


def test_names_are_not_resolved(world):
    name = world.text("robot.example")
    assert world.call(send=True, pHost=name)[0] == statuses.CLIENT_TCP_INVALID_HOST


def test_nobody_is_there(world):
    assert world.call(send=True, hostPort=81)[0] == ERR_FUB_BUSY
    assert world.run() == (statuses.CLIENT_TCP_CONN_FAILED, statuses.NOT_CONNECTED)


@pytest.mark.parametrize(
    ("answer", "status"),
    [
        (b"HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\n", statuses.CLIENT_TCP_DISCONNECTED),
        (b"SSH-2.0\r\n\r\n", statuses.CLIENT_TCP_DISCONNECTED),
        (b"HTTP/1.1 200 OK\r\n\r\n" + b"x" * 65, statuses.DATA_SIZE),
    ],
)
def test_a_response_that_is_none_or_too_long(world, answer, status):
    end, _ = world.exchange(answer, close=True)
    assert end == (status, statuses.NOT_CONNECTED)
    end, _ = world.exchange(ANSWER)
    assert end == (0, statuses.RECEIVED)


def test_a_response_that_never_comes(world):
    world.asked()
    world.now_ns += LIMIT_NS
    assert world.run(1) == (statuses.CLIENT_TCP_DISCONNECTED, statuses.NOT_CONNECTED)


@pytest.mark.parametrize(
    ("inputs", "found"),
    [({"abort": True}, 0), ({"enable": False}, ERR_FUB_ENABLE_FALSE)],
)
def test_an_exchange_is_ended_by_the_program(world, inputs, found):
    socket, _ = world.asked()
    assert world.call(**inputs) == (found, statuses.NOT_CONNECTED)
    world.now_ns += 10 * MS
    assert socket.recv(10).outcome is Outcome.CLOSED
    world.call(enable=True, abort=False)
    end, _ = world.exchange(ANSWER)
    assert end == (0, statuses.RECEIVED)


def test_a_restart_closes_connections(world):
    socket, _ = world.asked()
    world.context.restart()
    world.now_ns += 10 * MS
    assert socket.recv(10).outcome is Outcome.CLOSED


def test_there_is_no_tls():
    world = World("httpsClient")
    assert world.call(send=True) == (statuses.SSL_HANDSHAKE_FAILED, statuses.NOT_CONNECTED)
