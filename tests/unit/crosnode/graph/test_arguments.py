"""Remapping, arguments and environment of a node."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import InvalidNameError
from crosnode.graph.arguments import (
    DEFAULT_MASTER_URI,
    node_settings,
    parse_arguments,
    parse_parameter,
)


def test_remapping() -> None:
    arguments = ["a:=b", "/c:=/d", "~e:=f", "g:=~h", "file.txt", "-x"]
    settings = node_settings("node", arguments, namespace="/ns")
    resolve = settings.names.resolve
    assert [resolve(name) for name in ("a", "/ns/a", "/c", "~e", "g", "/a")] == [
        "/ns/b", "/ns/b", "/d", "/ns/f", "/ns/node/h", "/a",
    ]  # fmt: skip
    assert settings.arguments == ["file.txt", "-x"]


def test_special_arguments_before_environment_before_defaults() -> None:
    environment = {
        "ROS_MASTER_URI": "http://master:1/",
        "ROS_NAMESPACE": "env",
        "ROS_HOSTNAME": "name",
        "ROS_IP": "10.0.0.1",
    }
    arguments = [
        "__name:=other",
        "__ns:=/arg",
        "__master:=http://x:2/",
        "__ip:=1.2.3.4",
        "__log:=l",
    ]
    settings = node_settings("node", arguments, environment, namespace="ns", host="h")
    assert settings.names.node == "/arg/other"
    assert (settings.master_uri, settings.host) == ("http://x:2/", "1.2.3.4")
    settings = node_settings("node", [], environment, namespace="ns", host="h")
    assert settings.names.node == "/env/node"
    assert (settings.master_uri, settings.host) == ("http://master:1/", "name")
    del environment["ROS_HOSTNAME"]
    assert node_settings("node", [], environment).host == "10.0.0.1"
    settings = node_settings("node", namespace="ns", host="h")
    assert settings.names.node == "/ns/node"
    assert (settings.master_uri, settings.host) == (DEFAULT_MASTER_URI, "h")


def test_private_parameters() -> None:
    settings = node_settings("node", ["_rate:=10", "_sub/name:=true"], namespace="ns")
    assert settings.parameters == {"/ns/node/rate": 10, "/ns/node/sub/name": True}


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1),
        ("-5", -5),
        ("1.0", 1.0),
        ("1e-3", 0.001),
        ("True", True),
        ("false", False),
        (".5", 0.5),
        ("text", "text"),
        ("inf", "inf"),
        ("1_0", "1_0"),
        ("192.168.0.1", "192.168.0.1"),
        ("", ""),
        ("[1, 2.5]", [1, 2.5]),
        ('{"a": "b"}', {"a": "b"}),
        ("[a, {b: 1}]", ["a", {"b": 1}]),
        ("[a", "[a"),
        ("1" * 30, float("1" * 30)),
    ],
)
def test_parameter_values(text: str, value: object) -> None:
    parsed = parse_parameter(text)
    assert parsed == value
    assert type(parsed) is type(value)


@pytest.mark.parametrize("argument", ["a:=", "a:=b c", "a-b:=c", ":=c", "_:=1", "_a b:=1"])
def test_bad_remapping(argument: str) -> None:
    with pytest.raises(InvalidNameError):
        parse_arguments([argument])


@pytest.mark.parametrize("namespace", ["~a", "a b"])
def test_bad_namespace(namespace: str) -> None:
    with pytest.raises(InvalidNameError):
        node_settings("node", namespace=namespace)


@given(st.lists(st.text("a_:=/~ 1")))
def test_any_arguments(arguments: list[str]) -> None:
    try:
        found = parse_arguments(arguments)
    except InvalidNameError:
        return
    assert all(":=" not in argument for argument in found.rest)
