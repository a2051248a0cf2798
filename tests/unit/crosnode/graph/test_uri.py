"""URIs of nodes and services."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import InvalidNameError
from crosnode.graph.uri import Authority, make_uri, parse_uri


@pytest.mark.parametrize(
    ("uri", "scheme", "address"),
    [
        ("rosrpc://host:34691", "rosrpc", Authority("host", 34691)),
        ("rosrpc://host:34691/", "rosrpc", Authority("host", 34691)),
        ("http://10.0.0.1:80/", "http", Authority("10.0.0.1", 80)),
        ("http://[::1]:11311/", "http", Authority("::1", 11311)),
        ("http://::1:11311/", "http", Authority("::1", 11311)),  # as rospy with ROS_IP=::1
        ("rosrpc://fd00::12:4000", "rosrpc", Authority("fd00::12", 4000)),
        ("http://[fe80::1%eth0]:11311/RPC2", "http", Authority("fe80::1%eth0", 11311)),
    ],
)
def test_parse(uri: str, scheme: str, address: Authority) -> None:
    assert parse_uri(uri, scheme) == address


@pytest.mark.parametrize(
    "uri",
    ["", "http:", "http://", "http://h", "http://h:", "http://h:0/", "http://h:65536/",
     "rosrpc://h:1", "http://h:1x", "http://:1/", "http://a b:1/", "HTTP://h:1", "http://h:²/"],
)  # fmt: skip
def test_refused(uri: str) -> None:
    with pytest.raises(InvalidNameError, match="http://host:port/"):
        parse_uri(uri, "http")


def test_make() -> None:
    assert make_uri("http", "h", 1) == "http://h:1/"
    assert make_uri("rosrpc", "::1", 2) == "rosrpc://[::1]:2"
    assert make_uri("rosrpc", "[::1]", 2) == "rosrpc://[::1]:2"


@given(st.text())
def test_any_text(text: str) -> None:
    try:
        address = parse_uri(text, "http")
    except InvalidNameError:
        return
    assert parse_uri(make_uri("http", *address), "http") == address
