"""What every ``DatagramNetwork`` must do, whatever carries its datagrams."""

from __future__ import annotations

import pytest

from plcsim.network import Address, Option, Outcome

PATIENCE = 5_000


class Ends:
    """A server's and a client's socket."""

    def __init__(self, rig):
        self.rig = rig
        self.server = self.opened(rig.server)
        self.client = self.opened(rig.client)
        self.to_server = Address(rig.server_ip, self.server.local.port)

    def opened(self, network, **given):
        outcome, made = network.open_datagrams("", 0, **given)
        assert outcome is Outcome.OK
        return made

    def received(self, socket, size=1000, **given):
        """Wait for a datagram; return what came and from whom."""
        for _ in range(PATIENCE):
            found = socket.recv(size, **given)
            if found.outcome is not Outcome.WOULD_BLOCK:
                assert found.outcome is Outcome.OK
                return found
            self.rig.wait()
        pytest.fail("no datagram came")

    def pass_time(self):
        for _ in range(20):
            self.rig.wait()


class DatagramContract:
    """Subclasses give a fixture ``rig``."""

    @pytest.fixture
    def ends(self, rig):
        ends = Ends(rig)
        yield ends
        ends.server.close()
        ends.client.close()

    def test_a_datagram_arrives_whole_and_tells_its_sender(self, ends, rig):
        assert ends.client.send(b"hello", ends.to_server) == (Outcome.OK, 5)
        found = ends.received(ends.server)
        assert found.data == b"hello"
        assert found.peer == Address(rig.client_ip, ends.client.local.port)
        assert ends.server.recv(10).outcome is Outcome.WOULD_BLOCK

    def test_an_answer_comes_back(self, ends):
        ends.client.send(b"ask", ends.to_server)
        peer = ends.received(ends.server).peer
        ends.server.send(memoryview(b"answer"), peer)
        assert ends.received(ends.client).data == b"answer"

    def test_each_datagram_is_one(self, ends):
        for text in (b"one", b"two", b""):
            ends.client.send(text, ends.to_server)
            assert ends.received(ends.server).data == text

    def test_what_is_too_long_is_cut_and_the_rest_is_lost(self, ends):
        ends.client.send(b"0123456789", ends.to_server)
        assert ends.received(ends.server, 4).data == b"0123"
        ends.pass_time()
        assert ends.server.recv(100).outcome is Outcome.WOULD_BLOCK

    def test_peeking_leaves_it(self, ends):
        ends.client.send(b"here", ends.to_server)
        assert ends.received(ends.server, peek=True).data == b"here"
        assert ends.server.recv(100).data == b"here"

    def test_large_ones(self, ends):
        data = bytes(range(256)) * 30
        assert ends.client.send(data, ends.to_server).outcome is Outcome.OK
        assert ends.received(ends.server, 65_507).data == data
        assert ends.client.send(bytes(65_508), ends.to_server).outcome is Outcome.INVALID

    def test_a_fixed_other_side(self, ends, rig):
        assert ends.client.peer is None
        assert ends.client.send(b"x").outcome is Outcome.NOT_CONNECTED
        assert ends.client.connect(ends.to_server) is Outcome.OK
        assert ends.client.peer == ends.to_server
        assert ends.client.send(b"x").outcome is Outcome.OK
        peer = ends.received(ends.server).peer
        other = ends.opened(rig.server)
        other.send(b"from somebody else", peer)
        ends.server.send(b"from the other side", peer)
        assert ends.received(ends.client).data == b"from the other side"
        ends.pass_time()
        assert ends.client.recv(100).outcome is Outcome.WOULD_BLOCK
        assert ends.client.disconnect() is Outcome.OK
        other.send(b"again", peer)
        assert ends.received(ends.client).data == b"again"
        other.close()

    @pytest.mark.parametrize("ip", ["", "localhost", "300.1.1.1", "0.0.0.0"])
    def test_addresses_that_are_none(self, ends, ip):
        assert ends.client.send(b"x", Address(ip, 7)).outcome is Outcome.INVALID_ADDRESS
        assert ends.client.connect(Address(ip, 7)) is Outcome.INVALID_ADDRESS

    def test_a_port_is_taken_once_and_free_after_close(self, ends, rig):
        port = ends.server.local.port
        assert rig.server.open_datagrams("", port).outcome is Outcome.IN_USE
        ends.server.close()
        outcome, again = rig.server.open_datagrams("", port)
        assert outcome is Outcome.OK
        again.close()

    def test_ports_and_addresses_that_cannot_be(self, rig):
        assert rig.server.open_datagrams("x", 0).outcome is Outcome.INVALID_ADDRESS
        assert rig.server.open_datagrams("", 65_536).outcome is Outcome.INVALID
        assert rig.server.open_datagrams("203.0.113.5", 0).outcome is Outcome.NOT_LOCAL

    def test_a_closed_socket(self, ends):
        ends.client.close()
        assert ends.client.send(b"x", ends.to_server).outcome is Outcome.INVALID
        assert ends.client.recv(10).outcome is Outcome.INVALID
        assert ends.client.set_option(Option.BROADCAST, 1) is Outcome.INVALID
        assert ends.client.local.port == 0
        ends.client.close()

    def test_options(self, ends):
        assert ends.client.option(Option.BROADCAST) == (Outcome.OK, 0)
        assert ends.client.set_option(Option.BROADCAST, 5) is Outcome.OK
        assert ends.client.option(Option.BROADCAST) == (Outcome.OK, 1)
        assert ends.client.set_option(Option.RECEIVE_BUFFER, 10_000) is Outcome.OK
        assert ends.client.option(Option.RECEIVE_BUFFER).value == 10_000
        assert ends.client.set_option(Option.NO_DELAY, 1) is Outcome.INVALID
        assert ends.client.option(Option.NO_DELAY).outcome is Outcome.INVALID

    def test_no_size(self, ends):
        assert ends.server.recv(0).outcome is Outcome.INVALID

    def test_a_broadcast_must_be_allowed(self, ends):
        everybody = Address("255.255.255.255", 9)
        assert ends.client.send(b"x", everybody).outcome is Outcome.DENIED
