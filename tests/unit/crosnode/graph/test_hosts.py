import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import InvalidNameError
from crosnode.graph.hosts import HostTable, parse_hosts
from plcsim.network import Address


def test_names_are_found_without_a_name_server() -> None:
    hosts = HostTable({"Robot": "192.168.0.7"})
    assert hosts.address("http://robot:11311/", "http") == Address("192.168.0.7", 11311)
    assert hosts.resolve("localhost") == "127.0.0.1"
    assert hosts.resolve("10.0.0.1") == "10.0.0.1"


def test_an_unknown_name_says_where_to_add_it() -> None:
    with pytest.raises(InvalidNameError, match=r"'nowhere'.*\[ros.hosts\]"):
        HostTable().resolve("nowhere")


def test_a_hosts_file_is_read() -> None:
    text = (
        "127.0.0.1 localhost # x\n\n::1 ip6\n10.1.1.1\trobot robot.lan\n10.2.2.2 robot\n# 1.1.1.1"
    )
    assert parse_hosts(text) == {
        "localhost": "127.0.0.1",
        "robot": "10.1.1.1",
        "robot.lan": "10.1.1.1",
    }


@given(st.text())
def test_any_hosts_file_is_read_without_an_error(text: str) -> None:
    parse_hosts(text)
