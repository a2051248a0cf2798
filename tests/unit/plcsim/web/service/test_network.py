import os
import socket

from plcsim.web.service.host import processes
from plcsim.web.service.network import _address, sockets


def test_the_sockets_of_a_process_are_found_with_their_peers():
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
        with socket.create_connection(("127.0.0.1", port)) as client:
            accepted, _ = server.accept()
            accepted.send(b"seven b")
            own = f"127.0.0.1:{client.getsockname()[1]}"
            found = sockets([{"pid": os.getpid(), "name": "test"}])
            accepted.close()
    listening = next(each for each in found if each["local"] == f"127.0.0.1:{port}")
    assert {each["state"] for each in found} >= {"connected", "listening"}
    assert listening["process"] == "test"
    (end,) = [each for each in found if each["local"] == own]
    assert end["counts"].bytes_received == 7
    assert end == {
        "process": "test",
        "local": own,
        "peer": f"127.0.0.1:{port}",
        "state": "connected",
        "to_send": 0,
        "to_read": 7,
        "counts": end["counts"],
    }


def test_a_process_that_has_gone_has_no_sockets():
    assert sockets([{"pid": 2**22 + 1, "name": "gone"}]) == []


def test_addresses_as_people_write_them():
    assert _address("0100007F:1F90") == "127.0.0.1:8080"
    assert _address("00000000000000000000000001000000:0050") == "[::1]:80"
    assert _address("0000000000000000FFFF00000100007F:0050") == "127.0.0.1:80"


def test_a_process_is_described():
    (found,) = processes(os.getpid(), {os.getpid(): "supervisor"})[:1]
    assert found["name"] == "supervisor"
    assert found["rss"] > 1_000_000
    assert found["threads"] >= 1
    assert processes(2**22 + 1, {}) == []
