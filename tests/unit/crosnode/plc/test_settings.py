from collections.abc import Mapping
from pathlib import Path

import pytest

from crosnode.plc.settings import Publication, RosSettings, Subscription, read_settings
from plcsim.core.errors import ConfigurationError
from plcsim.settings.table import Table


def read(
    values: Mapping[str, object],
    environment: Mapping[str, str] | None = None,
    folder: Path = Path(),
) -> RosSettings:
    table = Table(folder / "plc.toml", "ros", values)
    return read_settings(table, environment or {}, "10.0.0.9 plant\n")


def test_defaults_are_those_of_ros() -> None:
    settings = read({})
    assert settings.master_uri == "http://localhost:11311/"
    assert settings.host == "127.0.0.1"
    assert settings.table.namespace == ""
    assert not settings.is_embedded
    assert settings.hosts == {"plant": "10.0.0.9"}


def test_the_environment_counts_and_the_table_goes_before_it() -> None:
    environment = {"ROS_MASTER_URI": "http://a:1", "ROS_IP": "10.0.0.1", "ROS_NAMESPACE": "cell"}
    assert read({}, environment).master_uri == "http://a:1"
    assert read({}, environment).host == "10.0.0.1"
    assert (
        read({}, environment).table.namespace == ""
    )  # that of the environment is the node's business
    settings = read({"master": "http://b:2", "host": "plc", "namespace": "/x"}, environment)
    assert (settings.master_uri, settings.host, settings.table.namespace) == (
        "http://b:2",
        "plc",
        "/x",
    )


def test_an_embedded_master_has_the_uri_of_the_host() -> None:
    settings = read({"master": "embedded", "master_port": 12345, "host": "10.1.1.1"})
    assert settings.is_embedded
    assert settings.master_uri == "http://10.1.1.1:12345/"


@pytest.mark.parametrize(
    ("values", "environment", "ipv6"),
    [
        ({}, {}, False),
        ({}, {"ROS_IPV6": "on"}, True),
        ({}, {"ROS_IPV6": "1"}, False),  # rospy and roscpp know "on" alone
        ({"ipv6": True}, {}, True),
        ({"ipv6": False}, {"ROS_IPV6": "on"}, False),
    ],
)
def test_ipv6_is_said_by_the_table_or_as_rospy_reads_it(
    values: dict[str, object], environment: dict[str, str], ipv6: bool
) -> None:
    settings = read(values, environment)
    assert settings.ipv6 is ipv6
    assert settings.host == ("::1" if ipv6 else "127.0.0.1")
    embedded = read(values | {"master": "embedded"}, environment)
    assert embedded.master_uri == ("http://[::1]:11311/" if ipv6 else "http://127.0.0.1:11311/")


def test_packages_hosts_and_the_bridge(tmp_path: Path) -> None:
    (tmp_path / "share").mkdir()
    settings = read(
        {
            "packages": ["share"],
            "hosts": {"Robot": "10.2.2.2"},
            "publish": {"/a": {"tag": "p.x", "type": "std_msgs/Bool", "every": "5ms"}},
            "subscribe": {"b": {"tag": "p.y", "type": "std_msgs/Bool"}},
        },
        {"ROS_PACKAGE_PATH": "/opt/share:"},
        tmp_path,
    )
    assert settings.packages == (tmp_path / "share", Path("/opt/share"))
    assert settings.hosts["robot"] == "10.2.2.2"
    assert settings.table.publish == {
        "/a": Publication(tag="p.x", type_name="std_msgs/Bool", every_ns=5_000_000)
    }
    assert settings.table.subscribe == {"b": Subscription(tag="p.y", type_name="std_msgs/Bool")}


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"master": "somewhere"}, "ros.master"),
        ({"master_port": 0}, "ros.master_port"),
        ({"packages": ["nowhere"]}, "ros.packages.*no such folder"),
        ({"hosts": {"x": "y"}}, "ros.hosts.x.*IP address"),
        ({"host": ""}, "ros.host: "),
        ({"host": "a b"}, "ros.host: "),
        ({"bind": "localhost"}, "ros.bind: 'localhost' is not an IP address"),
        ({"node": "a b"}, "ros.node"),
        ({"node": "/a/b"}, "ros.node: '/a/b' is not a ROS name without namespace"),
        ({"namespace": "~a"}, "ros.namespace: .* is private"),
        ({"arguments": ["__name:=x"]}, "ros.arguments: __name would give all nodes"),
        ({"namespace": "a b"}, "ros.namespace"),
        ({"arguments": ["a b:=c"]}, "ros.arguments"),
        ({"arguments": ["_p:=[null]"]}, "ros.arguments: parameter p: XML-RPC cannot carry"),
        ({"publish": {"/a": {"type": "std_msgs/Bool"}}}, "ros.publish./a.tag: is missing"),
        ({"publish": {"a b": {"tag": "x", "type": "y"}}}, "ros.publish.a b"),
        ({"publish": {"/a": {"tag": "x", "type": "y", "often": 1}}}, "ros.publish./a.often"),
        ({"subscribe": {"/a": {"tag": "x", "type": "y", "every": "1s"}}}, "ros.subscribe./a.every"),
        ({"subscribe": {"/a": 3}}, "ros.subscribe./a"),
        ({"unknown": 3}, "ros.unknown"),
    ],
)
def test_what_is_wrong_is_named(values: dict[str, object], words: str) -> None:
    with pytest.raises(ConfigurationError, match=words):
        read(values)
