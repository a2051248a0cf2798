"""What the master knows: nodes by name, and who publishes, subscribes, serves and watches."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final, NamedTuple

ANY_TYPE: Final = "*"


class RegisteredNode(NamedTuple):
    """A node as it registers itself: its name and the URI of its slave API."""

    name: str
    uri: str


class Replaced(NamedTuple):
    """A node that lost its name to another one, and the topics it published."""

    node: RegisteredNode
    topics: list[str]


@dataclass
class Registrations:
    """Nodes by what they registered for, in order of registration; empty entries vanish."""

    nodes: dict[str, list[RegisteredNode]] = field(default_factory=dict)

    def add(self, key: str, node: RegisteredNode) -> None:
        """Register a node once."""
        entry = self.nodes.setdefault(key, [])
        if node not in entry:
            entry.append(node)

    def remove(self, key: str, node: RegisteredNode) -> bool:
        """Unregister a node; return whether it was registered."""
        if node not in self.nodes.get(key, []):
            return False
        self.nodes[key].remove(node)
        if not self.nodes[key]:
            del self.nodes[key]
        return True

    def remove_all(self, node: RegisteredNode) -> list[str]:
        """Unregister a node from everything and return the keys."""
        keys = [key for key, nodes in self.nodes.items() if node in nodes]
        for key in keys:
            self.remove(key, node)
        return keys

    def uris(self, key: str) -> list[str]:
        """Return the URIs registered for a key."""
        return [node.uri for node in self.nodes.get(key, [])]

    def state(self) -> list[list[object]]:
        """Return ``[[key, [name, …]], …]``, as getSystemState does."""
        return [[key, [node.name for node in nodes]] for key, nodes in self.nodes.items()]

    def __len__(self) -> int:
        return sum(map(len, self.nodes.values()))


class Graph:
    """All registrations.

    Args:
        max_registrations: of all kinds together.
    """

    def __init__(self, max_registrations: int) -> None:
        self._max_registrations = max_registrations
        self.publishers = Registrations()
        self.subscribers = Registrations()
        self.services = Registrations()
        self.parameters = Registrations()
        self.service_uris: dict[str, str] = {}
        self.topic_types: dict[str, str] = {}
        self._nodes: dict[str, RegisteredNode] = {}

    @property
    def _kinds(self) -> tuple[Registrations, ...]:
        return (self.publishers, self.subscribers, self.services, self.parameters)

    def find(self, name: str) -> RegisteredNode | None:
        """Return the node of a name."""
        return self._nodes.get(name)

    def register(self, kind: Registrations, key: str, node: RegisteredNode) -> Replaced | None:
        """Register a node; return the node of the same name and another URI that it replaces.

        Raises:
            ValueError: there are too many registrations.
        """
        if sum(map(len, self._kinds)) >= self._max_registrations:
            raise ValueError(f"more than {self._max_registrations} registrations")
        old = self._nodes.get(node.name)
        replaced = Replaced(old, self._forget(old)) if old and old != node else None
        self._nodes[node.name] = node
        kind.add(key, node)
        return replaced

    def register_service(
        self, service: str, service_uri: str, node: RegisteredNode
    ) -> Replaced | None:
        """Register the provider of a service in the place of any other; as ``register``."""
        replaced = self.register(self.services, service, node)
        for other in [other for other in self.services.nodes[service] if other != node]:
            self.services.remove(service, other)
            self._clean(other)
        self.service_uris[service] = service_uri
        return replaced

    def unregister(self, kind: Registrations, key: str, node: RegisteredNode) -> bool:
        """Unregister a node; return whether it was registered."""
        removed = kind.remove(key, node)
        self._clean(node)
        return removed

    def unregister_service(self, service: str, service_uri: str, name: str) -> bool:
        """Unregister a provider, where name and URI are still the registered ones."""
        node = self._nodes.get(name)
        known = self.service_uris.get(service, "").rstrip("/")
        if node is None or not known or known != service_uri.rstrip("/"):
            return False
        return self.unregister(self.services, service, node)

    def set_topic_type(self, topic: str, type_name: str, *, by_publisher: bool) -> None:
        """Note the type of a topic: a publisher decides, a subscriber only where none is known."""
        if type_name == ANY_TYPE:
            if by_publisher:
                self.topic_types.setdefault(topic, ANY_TYPE)
        elif by_publisher or self.topic_types.get(topic, ANY_TYPE) == ANY_TYPE:
            self.topic_types[topic] = type_name

    def _forget(self, node: RegisteredNode) -> list[str]:
        """Unregister a node from everything and return the topics it published."""
        topics = self.publishers.remove_all(node)
        for kind in self._kinds:
            kind.remove_all(node)
        self._clean(node)
        return topics

    def _clean(self, node: RegisteredNode) -> None:
        """Drop what no registration refers to any more."""
        is_used = any(node in nodes for kind in self._kinds for nodes in kind.nodes.values())
        if not is_used and self._nodes.get(node.name) == node:
            del self._nodes[node.name]
        for service in self.service_uris.keys() - self.services.nodes.keys():
            del self.service_uris[service]
        topics = self.publishers.nodes.keys() | self.subscribers.nodes.keys()
        for topic in self.topic_types.keys() - topics:
            del self.topic_types[topic]
