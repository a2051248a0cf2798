"""Who is registered for what."""

import pytest

from crosnode.master.registrations import Graph, RegisteredNode, Registrations, Replaced

A, A2, B = (
    RegisteredNode("/a", "http://h:1/"),
    RegisteredNode("/a", "http://h:2/"),
    RegisteredNode("/b", "http://h:3/"),
)


def test_registrations() -> None:
    entries = Registrations()
    entries.add("/t", A)
    entries.add("/t", B)
    entries.add("/t", A)
    assert entries.uris("/t") == ["http://h:1/", "http://h:3/"]
    assert entries.state() == [["/t", ["/a", "/b"]]]
    assert not entries.remove("/t", A2)
    assert entries.remove("/t", A)
    entries.remove_all(B)
    assert entries.nodes == {}


def test_node_with_the_same_name_replaces_the_other_everywhere() -> None:
    graph = Graph(100)
    graph.register(graph.publishers, "/t", A)
    graph.register(graph.subscribers, "/u", A)
    graph.register(graph.parameters, "/p", A)
    graph.register_service("/s", "rosrpc://h:9", A)
    assert graph.register(graph.publishers, "/v", A2) == Replaced(A, ["/t"])
    assert graph.publishers.nodes == {"/v": [A2]}
    assert not graph.subscribers.nodes
    assert not graph.parameters.nodes
    assert graph.service_uris == {}
    assert graph.find("/a") == A2


def test_node_is_known_until_its_last_registration() -> None:
    graph = Graph(100)
    graph.register(graph.publishers, "/t", A)
    graph.register(graph.subscribers, "/t", A)
    graph.unregister(graph.publishers, "/t", A)
    assert graph.find("/a") == A
    graph.unregister(graph.subscribers, "/t", A)
    assert graph.find("/a") is None


def test_newest_provider_serves() -> None:
    graph = Graph(100)
    graph.register_service("/s", "rosrpc://h:9", A)
    graph.register_service("/s", "rosrpc://h:8/", B)
    assert graph.services.state() == [["/s", ["/b"]]]
    assert graph.find("/a") is None
    assert not graph.unregister_service("/s", "rosrpc://h:9", "/a")
    assert not graph.unregister_service("/s", "rosrpc://h:9", "/b")
    assert graph.unregister_service("/s", "rosrpc://h:8", "/b")
    assert graph.service_uris == {}


def test_topic_types() -> None:
    graph = Graph(100)
    graph.register(graph.subscribers, "/t", A)
    graph.set_topic_type("/t", "*", by_publisher=False)
    assert graph.topic_types == {}
    graph.set_topic_type("/t", "a/B", by_publisher=False)
    graph.set_topic_type("/t", "c/D", by_publisher=False)
    assert graph.topic_types == {"/t": "a/B"}
    graph.register(graph.publishers, "/t", B)
    graph.set_topic_type("/t", "*", by_publisher=True)
    assert graph.topic_types == {"/t": "a/B"}
    graph.set_topic_type("/t", "c/D", by_publisher=True)
    assert graph.topic_types == {"/t": "c/D"}
    graph.unregister(graph.publishers, "/t", B)
    graph.unregister(graph.subscribers, "/t", A)
    assert graph.topic_types == {}


def test_limit() -> None:
    graph = Graph(2)
    graph.register(graph.publishers, "/t", A)
    graph.register(graph.subscribers, "/t", A)
    with pytest.raises(ValueError, match="more than 2 registrations"):
        graph.register(graph.parameters, "/t", A)
