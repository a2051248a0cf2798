"""Seeded fuzz of a Modbus TCP server: every connection must answer or be closed.

    python benchmarks/modbus_fuzz.py --port 1502 [--seconds 60] [--seed 1]

Each input is one of: a request with random fields, a random PDU, several requests at once, a
request in pieces, a header that lies, random bytes, another protocol. After each, the connection
must be closed by the server or answer a probe; every answer must have the transaction and the
function of a request. Exit code 1 where one did not.
"""

from __future__ import annotations

import argparse
import random
import socket
import struct
import sys
import time
from collections import Counter
from typing import NamedTuple

TIMEOUT_S = 3.0
PROBE = bytes.fromhex("03 0000 0001")
FUNCTIONS = (1, 2, 3, 4, 5, 6, 8, 15, 16, 17, 22, 23, 43)


class Input(NamedTuple):
    """What is sent: its kind, its pieces, the PDUs that are to be answered by transaction.

    ``may_close`` is True where the server is right to close the connection.
    """

    kind: str
    pieces: list[bytes]
    asked: dict[int, bytes]
    may_close: bool


class Fuzzer:
    """One connection after another, with inputs that the seed determines."""

    def __init__(self, port: int, seed: int) -> None:
        self._port = port
        self._random = random.Random(seed)
        self._transaction = 0
        self._socket: socket.socket | None = None
        self.counts: Counter[str] = Counter()

    def _frame(self, pdu: bytes) -> tuple[int, bytes]:
        self._transaction = self._transaction % 0xFFFF + 1
        unit = self._random.randrange(256)
        header = struct.pack(">HHHB", self._transaction, 0, len(pdu) + 1, unit)
        return self._transaction, header + pdu

    def _request(self) -> bytes:
        """Return a request of a known function with random fields."""
        rng = self._random
        function = rng.choice(FUNCTIONS)
        address, count = rng.choice((0, 4, 14, rng.randrange(65536))), rng.randrange(140)
        body = struct.pack(">HH", address, rng.choice((count, 0, 1, 125, 126, 2000, 2001, 65535)))
        if function in (15, 16):
            data = rng.randbytes(rng.randrange(247))
            body += bytes([rng.choice((len(data), rng.randrange(256)))]) + data
        elif function == 22:
            body += rng.randbytes(2)
        elif function == 23:
            data = rng.randbytes(rng.randrange(243))
            body += struct.pack(">HHB", address, len(data) // 2, len(data)) + data
        elif function == 43:
            body = bytes([rng.choice((14, 13)), rng.randrange(6), rng.randrange(9)])
        return bytes([function]) + body

    def _pdu(self) -> bytes:
        rng = self._random
        if rng.random() < 0.5:
            return self._request()
        return rng.randbytes(rng.choice((1, 2, 5, rng.randrange(1, 254))))

    def _many(self, count: int) -> Input:
        frames = [(self._pdu()) for _ in range(count)]
        asked, data = {}, b""
        for pdu in frames:
            transaction, frame = self._frame(pdu)
            asked[transaction] = pdu
            data += frame
        return Input("pipelined" if count > 1 else "request", [data], asked, may_close=False)

    def _in_pieces(self) -> Input:
        whole = self._many(self._random.randrange(1, 4))
        data = whole.pieces[0]
        cuts = sorted(self._random.randrange(len(data)) for _ in range(4))
        pieces = [data[a:b] for a, b in zip([0, *cuts], [*cuts, len(data)], strict=True)]
        return whole._replace(kind="in pieces", pieces=[piece for piece in pieces if piece])

    def _lie(self) -> Input:
        rng = self._random
        protocol, length = rng.choice(
            ((rng.randrange(1, 65536), 6), (0, 0), (0, 1), (0, rng.randrange(255, 65536)))
        )
        data = struct.pack(">HHHB", 1, protocol, length, 1) + self._pdu()
        return Input("lying header", [data], {}, may_close=True)

    def _noise(self) -> Input:
        data = self._random.randbytes(self._random.randrange(8, 600))
        return Input("noise", [data], {}, may_close=True)

    def _other_protocol(self) -> Input:
        text = self._random.choice(
            (
                b"GET / HTTP/1.1\r\nHost: plc\r\n\r\n",
                bytes.fromhex("160301020001"),
                b"SSH-2.0-x\r\n",
            )
        )
        return Input("other protocol", [text + bytes(8)], {}, may_close=True)

    def next(self) -> Input:
        """Return the next input."""
        make = self._random.choice(
            (lambda: self._many(1), lambda: self._many(1), lambda: self._many(16),
             self._in_pieces, self._lie, self._noise, self._other_protocol)
        )  # fmt: skip
        return make()

    def run(self, seconds: float) -> bool:
        """Return True where nothing was wrong."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            made = self.next()
            self.counts["inputs"] += 1
            self.counts[made.kind] += 1
            try:
                self._try(made)
            except TimeoutError:
                self._report("wedged", made)
            except (ConnectionError, EOFError):
                self._socket = None
                if not made.may_close:
                    self._report("closed without reason", made)
        return not any(
            self.counts[name]
            for name in ("wedged", "wrong function", "not asked for", "closed without reason")
        )

    def _report(self, what: str, made: Input) -> None:
        self.counts[what] += 1
        self._socket = None
        if self.counts[what] <= 5:
            sys.stderr.write(f"{what}: {made.kind} {b''.join(made.pieces).hex()[:200]}\n")

    def _try(self, made: Input) -> None:
        if self._socket is None:
            self._socket = self._connected()
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        for piece in made.pieces:
            self._socket.sendall(piece)
        if made.may_close:
            # noise may claim more bytes than it has; then the end of the stream must end it
            self._socket.shutdown(socket.SHUT_WR)
            while self._socket.recv(4096):
                pass
            raise EOFError
        transaction, frame = self._frame(PROBE)
        self._socket.sendall(frame)
        waiting = {**made.asked, transaction: PROBE}
        while waiting:
            header = self._exactly(7)
            answered, _, length, _ = struct.unpack(">HHHB", header)
            pdu = self._exactly(length - 1)
            asked = waiting.pop(answered, None)
            if asked is None:
                self._report("not asked for", made)
                return
            if pdu[0] not in (asked[0], asked[0] | 0x80):
                self._report("wrong function", made)
                return
            self.counts["answers"] += 1

    def _connected(self) -> socket.socket:
        """Return a new connection; the server may just be starting."""
        end = time.monotonic() + TIMEOUT_S
        while True:
            try:
                return socket.create_connection(("127.0.0.1", self._port), TIMEOUT_S)
            except ConnectionRefusedError:
                if time.monotonic() > end:
                    raise SystemExit(f"nothing listens on port {self._port}") from None
                time.sleep(0.05)

    def _exactly(self, count: int) -> bytes:
        assert self._socket is not None
        data = b""
        while len(data) < count:
            piece = self._socket.recv(count - len(data))
            if not piece:
                raise EOFError
            data += piece
        return data


def main() -> int:
    parser = argparse.ArgumentParser(description="Seeded fuzz of a Modbus TCP server.")
    parser.add_argument("--port", type=int, required=True)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    fuzzer = Fuzzer(options.port, options.seed)
    right = fuzzer.run(options.seconds)
    names = (
        "inputs",
        "answers",
        "wedged",
        "wrong function",
        "not asked for",
        "closed without reason",
    )
    print(f"seed {options.seed}: " + ", ".join(f"{n} {fuzzer.counts[n]}" for n in names))
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
