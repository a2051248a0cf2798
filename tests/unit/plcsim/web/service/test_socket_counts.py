import os
import socket
from operator import sub

from plcsim.web.service.socket_counts import SocketCounts, socket_counts


def test_bytes_and_segments_are_counted_at_both_ends():
    with socket.create_server(("127.0.0.1", 0)) as server:
        client = socket.create_connection(server.getsockname())
        peer, _ = server.accept()
        with client, peer:
            ends = [os.fstat(end.fileno()).st_ino for end in (client, peer)]
            before = [socket_counts()[end] for end in ends]
            for _ in range(3):
                client.sendall(b"12345678")
                peer.recv(8, socket.MSG_WAITALL)
                peer.sendall(b"ok")  # what came is acknowledged with it
                client.recv(2, socket.MSG_WAITALL)
            after = [socket_counts()[end] for end in ends]
    sent, taken = (SocketCounts(*map(sub, *both)) for both in zip(after, before, strict=True))
    assert (sent.bytes_sent, sent.segments_sent, sent.bytes_received) == (24, 3, 6)
    assert (taken.bytes_received, taken.segments_received, taken.segments_sent) == (24, 3, 3)


def test_where_the_kernel_does_not_tell_nothing_is_counted(monkeypatch):
    def refuse(*_):
        raise OSError

    monkeypatch.setattr("plcsim.web.service.socket_counts.socket.socket", refuse)
    assert socket_counts() == {}
