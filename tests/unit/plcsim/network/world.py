"""A virtual net with a clock that a test sets, and shortcuts for its sockets."""

from __future__ import annotations

from plcsim.network import Address, Link, Outcome, Socket, VirtualNetwork, WireLimits

SERVER = "192.168.0.10"
CLIENT = "192.168.0.20"
MS = 1_000_000
SECOND = 1_000_000_000


class World:
    def __init__(
        self, *, seed: int = 0, link: Link | None = None, limits: WireLimits | None = None
    ) -> None:
        self.now_ns = 0
        self.net = VirtualNetwork(
            lambda: self.now_ns, seed=seed, link=link, limits=limits, call_ns=0
        )
        self.faults = self.net.faults
        self.server = self.net.host(SERVER)
        self.client = self.net.host(CLIENT)

    def listen(self, port: int = 502, backlog: int = 3) -> Socket:
        listener = self.server.open("", port, reuse_address=True).socket
        assert listener is not None
        assert listener.listen(backlog) is Outcome.OK
        return listener

    def dial(self, port: int = 502, ip: str = SERVER) -> tuple[Socket, Address]:
        """Start to connect; return the client's socket and the target to poll with."""
        client = self.client.open("", 0).socket
        assert client is not None
        target = Address(ip, port)
        assert client.connect(target) is Outcome.WOULD_BLOCK
        return client, target

    def connect(self, listener: Socket) -> tuple[Socket, Socket]:
        """Connect by way of the fixed time of two latencies; return client and server."""
        port = listener.local.port
        client, target = self.dial(port)
        link = self.net.link(SERVER, CLIENT)
        self.now_ns += 2 * (link.latency_ns + link.jitter_ns)
        assert client.connect(target) is Outcome.OK
        server = listener.accept().socket
        assert server is not None
        return client, server

    def pair(self) -> tuple[Socket, Socket]:
        return self.connect(self.listen())

    def outcome_at(self, now_ns: int, reader: Socket) -> Outcome:
        self.now_ns = now_ns
        return reader.recv(100).outcome
