import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import InvalidNameError
from crosnode.graph.hosts import HostTable, own_interface, parse_hosts
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
        "ip6": "::1",
        "robot": "10.1.1.1",
        "robot.lan": "10.1.1.1",
    }


@pytest.mark.parametrize(("ipv6", "ip"), [(False, "10.1.1.1"), (True, "fd00::1")])
def test_a_name_with_addresses_of_both_kinds_has_the_one_that_is_wanted(
    ipv6: bool, ip: str
) -> None:
    text = "fd00::1 robot\n10.1.1.1 robot\nfd00::2 robot only6\n10.1.1.2 robot only4"
    hosts = parse_hosts(text, ipv6=ipv6)
    assert hosts == {"robot": ip, "only6": "fd00::2", "only4": "10.1.1.2"}


@pytest.mark.parametrize(
    ("host", "ipv6", "interface"),
    [
        ("localhost", False, "127.0.0.1"),
        ("localhost", True, "::1"),
        ("::1", False, "::1"),
        ("10.0.0.1", True, "10.0.0.1"),
        ("robot", False, ""),
        ("robot", True, "::"),
    ],
)
def test_the_own_interface_is_that_of_the_host(host: str, ipv6: bool, interface: str) -> None:
    assert own_interface(host, ipv6=ipv6) == interface


def test_addresses_of_ipv6_are_written_one_way() -> None:
    hosts = HostTable({"six": "FD00:0:0::1"}, ipv6=True)
    assert hosts.address("http://[0:0::1]:11311/", "http") == Address("::1", 11311)
    assert hosts.address("http://six:11311", "http") == Address("fd00::1", 11311)
    assert hosts.resolve("localhost") == "::1"


@given(st.text())
def test_any_hosts_file_is_read_without_an_error(text: str) -> None:
    parse_hosts(text)
