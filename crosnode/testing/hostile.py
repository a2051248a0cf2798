"""What hostile peers say to the ports of a ROS 1 node or master: seeded, repeatable bytes.

Some kinds break TCPROS or XML-RPC, some keep to it and are a burden all the same. What ROS 1 lets
any caller do with a node by its name is left out (``shutdown``, another's registrations): a node
that obeys is no fault.
"""

from __future__ import annotations

import random
import struct
import xmlrpc.client
from enum import Enum, auto
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from crosnode.tcpros.header import encode_header

if TYPE_CHECKING:
    from collections.abc import Callable

NORMAL: Final = 0.02
PATIENT: Final = 0.004
"""Chance of a turn that a peer leaves: soon, or late."""

URIS: Final = ("http://127.0.0.1:1/", "http://127.0.0.1:9/", "http://nowhere:1/", "ftp://x", "")
"""Where callers say that their nodes are; nobody is there."""

VALUES: Final[tuple[Any, ...]] = (
    1,
    "x" * 2000,
    [1] * 500,
    {"a": {"b": 1.5}},
    True,
    -1.0,
    "",
    [[], {}],
)
MULTICALLS: Final = (2, 50, 200, 1000)
LENGTHS: Final = (0, 1, 5, 2**31 - 1, 2**31, 2**32 - 1)


class Speaks(Enum):
    """Which protocol a port speaks."""

    XMLRPC = auto()
    TCPROS = auto()


class HostilePeer(NamedTuple):
    """One connection.

    Attributes:
        kind: in words, for counts.
        data: all that it says.
        piece: bytes that it sends at once at most, 0 for as many as go.
        reads: whether it takes what it is answered.
        leaves: chance of a turn that it leaves, whatever it still had to say.
    """

    kind: str
    data: bytes
    piece: int = 0
    reads: bool = True
    leaves: float = NORMAL


class HostilePeers:
    """Peers one after another, as the seed determines them.

    Args:
        seed: equal seeds give equal peers.
        topic: that the node under attack publishes.
        service: that it provides.
    """

    def __init__(self, seed: int, topic: str = "/chatter", service: str = "/set") -> None:
        self.random = random.Random(seed)  # noqa: S311  # repeatable on purpose
        self._topic = topic
        self._service = service

    def next(self, speaks: Speaks) -> HostilePeer:
        """Return the next peer for a port."""
        kind = self.random.choice(_KINDS[speaks])
        return _COMMON[kind](self, speaks) if kind in _COMMON else self._plain(kind)

    def _plain(self, kind: str) -> HostilePeer:
        return HostilePeer(kind, (_XMLRPC | _TCPROS)[kind](self))

    def _any(self, speaks: Speaks) -> bytes:
        kinds = _XMLRPC if speaks is Speaks.XMLRPC else _TCPROS
        return self.random.choice(list(kinds.values()))(self)

    # what a port of either protocol may meet

    def _silence(self, _speaks: Speaks) -> HostilePeer:
        return HostilePeer("silence", b"", leaves=PATIENT)

    def _noise(self, _speaks: Speaks) -> HostilePeer:
        return HostilePeer("noise", self.random.randbytes(self.random.choice((1, 5, 80, 5000))))

    def _one_byte_at_a_time(self, speaks: Speaks) -> HostilePeer:
        return HostilePeer("one byte at a time", self._any(speaks), piece=1, leaves=PATIENT)

    def _wrong_door(self, speaks: Speaks) -> HostilePeer:
        other = Speaks.TCPROS if speaks is Speaks.XMLRPC else Speaks.XMLRPC
        return HostilePeer("the other protocol", self._any(other))

    def _never_reads(self, speaks: Speaks) -> HostilePeer:
        """Ask for much in a legal way, a topic or a hundred answers, and take nothing."""
        legal = self._burst() if speaks is Speaks.XMLRPC else encode_header(self._header())
        return HostilePeer("legal, never reads", legal, reads=False, leaves=PATIENT)

    # XML-RPC

    def _burst(self) -> bytes:
        """Return many legal calls over one connection."""
        count = self.random.choice((1, 5, 40))
        return b"".join(_request(_document(*self._call())) for _ in range(count))

    def _call(self) -> tuple[str, tuple[Any, ...]]:
        choose = self.random.choice
        number = self.random.randrange(1000)
        me, name, uri = f"/evil{number % 50}", f"/evil/{number}", choose(URIS)
        topic, value = choose((self._topic, name)), choose(VALUES)
        state = [{"methodName": "getSystemState", "params": [me]}] * choose(MULTICALLS)
        info = [{"methodName": "getBusInfo", "params": [me]}] * choose(MULTICALLS)
        return choose(
            (
                ("getSystemState", (me,)),
                ("getPublishedTopics", (me, "")),
                ("lookupNode", (me, name)),
                ("registerPublisher", (me, topic, "*", uri)),
                ("registerSubscriber", (me, topic, "*", uri)),
                ("registerService", (me, name, "rosrpc://127.0.0.1:1", uri)),
                ("unregisterPublisher", (me, topic, uri)),
                ("setParam", (me, name, value)),
                ("getParam", (me, "/")),
                ("subscribeParam", (me, uri, name)),
                ("deleteParam", (me, name)),
                ("system.multicall", (state,)),
                ("system.multicall", (info,)),
                ("getBusInfo", (me,)),
                ("getBusStats", (me,)),
                ("getPid", (me,)),
                ("requestTopic", (me, topic, [["TCPROS"]])),
                ("publisherUpdate", (me, name, [uri] * choose((1, 500)))),
                ("paramUpdate", (me, name, value)),
            )
        )

    def _wrong_arguments(self) -> bytes:
        method, params = self._call()
        wrong = list(params[: self.random.randrange(len(params) + 1)])
        if self.random.random() < 0.5:
            wrong.insert(self.random.randrange(len(wrong) + 1), self.random.choice(VALUES))
        return _request(_document(method, tuple(wrong)))

    def _xml_bomb(self) -> bytes:
        levels = "".join(f'<!ENTITY a{n + 1} "{f"&a{n};" * 10}">' for n in range(9))
        document = (
            f'<!DOCTYPE a [<!ENTITY a0 "ha">{levels}]>'
            "<methodCall><methodName>&a9;</methodName></methodCall>"
        )
        return _request(document.encode())

    def _deep_nesting(self) -> bytes:
        depth = self.random.choice((50, 2_000, 20_000))
        head = b"<methodCall><methodName>setParam</methodName><params><param>"
        return _request(head + b"<value><array><data>" * depth)

    def _broken_xml(self) -> bytes:
        document = bytearray(_document(*self._call()))
        for _ in range(3):
            document[self.random.randrange(len(document))] = self.random.randrange(256)
        return _request(bytes(document))

    def _half_a_request(self) -> bytes:
        whole = _request(_document(*self._call()))
        return whole[: self.random.randrange(len(whole))]

    def _lying_length(self) -> bytes:
        length = self.random.choice(("1000000000000", "-1", "0", "x", str(2**64), ""))
        return _request(_document("getPid", ("/evil",)), length)

    def _other_http(self) -> bytes:
        head = b"POST /RPC2 HTTP/1.1\r\nHost: x\r\n"
        return self.random.choice(
            (
                b"GET / HTTP/1.0\r\n\r\n",
                head + b"\r\n",
                head + b"Transfer-Encoding: chunked\r\n\r\nFFFFFFFF\r\nx",
                head + b"X: " + b"x" * 100_000,
                head + b"Expect: 100-continue\r\nContent-Length: 9\r\n\r\n",
            )
        )

    # TCPROS

    def _header(self, **changed: str) -> dict[str, str]:
        """Return a header that publishers and services of any type take."""
        header = {"callerid": "/evil", "topic": self._topic, "service": self._service,
                  "md5sum": "*", "type": "*", "persistent": self.random.choice("01")}  # fmt: skip
        return header | changed

    def _wrong_md5(self) -> bytes:
        return encode_header(self._header(md5sum=f"{self.random.getrandbits(128):032x}"))

    def _missing_field(self) -> bytes:
        header = self._header()
        del header[self.random.choice(("callerid", "topic", "service", "md5sum"))]
        return encode_header(header)

    def _unknown_names(self) -> bytes:
        name = self.random.choice(("/none", "", "x" * 3000, "\x00\x1b[31m"))
        return encode_header(self._header(callerid=name, topic=name, service=name))

    def _half_a_header(self) -> bytes:
        whole = encode_header(self._header())
        return whole[: self.random.randrange(len(whole))]

    def _large_header(self) -> bytes:
        size = self.random.choice((50_000, 120_000, 200_000))
        return encode_header(self._header(comment="x" * size))

    def _lying_field(self) -> bytes:
        body = struct.pack("<I", self.random.choice(LENGTHS)) + b"callerid"
        return struct.pack("<I", len(body)) + body

    def _huge_length(self) -> bytes:
        return struct.pack("<I", self.random.choice((2**31, 2**32 - 1))) + b"x" * 100

    def _nonsense_behind_a_header(self) -> bytes:
        frames = (struct.pack("<I", self.random.choice(LENGTHS)) + b"abcde" for _ in range(3))
        probe = self.random.choice("01")
        return encode_header(self._header(probe=probe)) + b"".join(frames)


def _document(method: str, params: tuple[Any, ...]) -> bytes:
    return xmlrpc.client.dumps(params, method).encode()


def _request(document: bytes, length: str | None = None) -> bytes:
    said = str(len(document)) if length is None else length
    head = f"POST /RPC2 HTTP/1.1\r\nHost: x\r\nContent-Length: {said}\r\n\r\n"
    return head.encode() + document


_COMMON: Final[dict[str, Callable[[HostilePeers, Speaks], HostilePeer]]] = {
    "silence": HostilePeers._silence,
    "noise": HostilePeers._noise,
    "one byte at a time": HostilePeers._one_byte_at_a_time,
    "the other protocol": HostilePeers._wrong_door,
    "legal, never reads": HostilePeers._never_reads,
}

_XMLRPC: Final[dict[str, Callable[[HostilePeers], bytes]]] = {
    "burst of legal calls": HostilePeers._burst,
    "wrong arguments": HostilePeers._wrong_arguments,
    "XML bomb": HostilePeers._xml_bomb,
    "deep nesting": HostilePeers._deep_nesting,
    "broken XML": HostilePeers._broken_xml,
    "half a request": HostilePeers._half_a_request,
    "lying Content-Length": HostilePeers._lying_length,
    "other HTTP": HostilePeers._other_http,
}

_TCPROS: Final[dict[str, Callable[[HostilePeers], bytes]]] = {
    "wrong md5": HostilePeers._wrong_md5,
    "header without a field": HostilePeers._missing_field,
    "unknown names": HostilePeers._unknown_names,
    "half a header": HostilePeers._half_a_header,
    "large header": HostilePeers._large_header,
    "lying field length": HostilePeers._lying_field,
    "huge length": HostilePeers._huge_length,
    "nonsense behind a header": HostilePeers._nonsense_behind_a_header,
}

_KINDS: Final = {
    Speaks.XMLRPC: [*_COMMON, *_XMLRPC],
    Speaks.TCPROS: [*_COMMON, *_TCPROS],
}
