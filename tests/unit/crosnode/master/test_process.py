"""A master in a process of its own."""

import pytest

from crosnode.master.process import MasterProcess
from tests.ports import free_port


def test_a_shutdown_by_the_api_ends_it() -> None:
    process = MasterProcess("localhost", free_port(), "127.0.0.1", {})
    process.server.master.is_shut_down = True
    process.run(lambda: True)
    assert not process.server.is_open


@pytest.mark.parametrize(
    ("host", "bind_ip", "own_ip"),
    [
        ("localhost", None, "127.0.0.1"),
        ("127.0.0.1", None, "127.0.0.1"),
        ("plant", None, ""),
        ("plant", "127.0.0.1", "127.0.0.1"),
        ("127.0.0.1", "", ""),
    ],
)
def test_it_listens_where_its_host_is(host: str, bind_ip: str | None, own_ip: str) -> None:
    server = MasterProcess(host, 0, bind_ip, {}).server
    assert server.is_open
    assert server.bind_ip == own_ip
    server.close()


def test_a_host_that_is_not_this_one() -> None:
    process = MasterProcess("192.0.2.1", 0, None, {})
    assert process.refusal
    assert process.refusal.text == "'192.0.2.1' is no address of this host"
