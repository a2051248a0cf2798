"""What ``plcsim ros topic`` does."""

from __future__ import annotations

import json
import math
import sys
from typing import TYPE_CHECKING, Any, Final

from crosnode.commands.client import CALLER, acting
from crosnode.errors import MessageValueError
from crosnode.graph.flow_yaml import parse_flow
from crosnode.messages import from_json
from crosnode.messages.yaml_text import to_yaml
from plcsim.core.errors import PlcError

if TYPE_CHECKING:
    import argparse

    from crosnode.commands.client import RosClient
    from crosnode.messages import Message, MessageType, MessageTypes
    from crosnode.node import Publisher, Subscriber

NS_PER_S: Final = 1_000_000_000
QUEUE: Final = 10_000
ONCE_NS: Final = 3 * NS_PER_S
"""Nanoseconds that a message published once stays, as with ``rostopic pub -1``."""

WINDOW: Final = 1_000
"""Messages that a rate is taken over."""


def _print(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def list_topics(client: RosClient, _options: argparse.Namespace) -> None:
    """Print name and type of all topics."""
    publishers, subscribers, _ = client.call_master("getSystemState")
    types = dict(client.call_master("getTopicTypes"))
    for topic in sorted({topic for topic, _ in (*publishers, *subscribers)}):
        _print(f"{topic} [{types.get(topic, '*')}]")


def tell_topic(client: RosClient, options: argparse.Namespace) -> None:
    """Print type, publishers and subscribers of a topic.

    Raises:
        PlcError: nobody publishes it or subscribes to it.
    """
    topic = client.settings.names.resolve(options.topic)
    state = client.call_master("getSystemState")
    types = dict(client.call_master("getTopicTypes"))
    kinds = {"Publishers": dict(state[0]), "Subscribers": dict(state[1])}
    if not any(topic in nodes for nodes in kinds.values()):
        raise PlcError(f"{topic}: nobody publishes it or subscribes to it")
    _print(f"Type: {types.get(topic, '*')}")
    for title, nodes in kinds.items():
        names = nodes.get(topic, [])
        _print(f"\n{title}:" + ("" if names else " None"))
        for name in names:
            _print(f" * {name} ({client.call_master('lookupNode', name)})")


def _subscribe(client: RosClient, options: argparse.Namespace) -> Subscriber:
    topic = client.settings.names.resolve(options.topic)
    message_type = client.topic_type(topic)
    return client.node.register_subscriber(topic, message_type.name, queue_size=QUEUE)


def echo(client: RosClient, options: argparse.Namespace) -> None:
    """Print messages until there were as many as asked for."""
    subscriber = _subscribe(client, options)
    count = 0
    while options.count is None or count < options.count:
        client.wait(lambda: subscriber.queue, None)
        message = subscriber.pop()
        if message is not None:
            count += 1
            text = to_yaml(client.types, subscriber.message_type, message)
            _print(f"{text}---")


class Rate:
    """How often something happened, within the last ``WINDOW`` times."""

    def __init__(self) -> None:
        self._gaps_ns: list[int] = []
        self._last_ns: int | None = None

    def add(self, now_ns: int) -> None:
        """Note that it happened."""
        if self._last_ns is not None:
            self._gaps_ns = [*self._gaps_ns[-WINDOW + 1 :], now_ns - self._last_ns]
        self._last_ns = now_ns

    def __str__(self) -> str:
        gaps = [gap_ns / NS_PER_S for gap_ns in self._gaps_ns]
        if not sum(gaps):
            return "no new messages"
        mean = sum(gaps) / len(gaps)
        deviation = math.sqrt(sum((gap - mean) ** 2 for gap in gaps) / len(gaps))
        return (
            f"average rate: {1 / mean:.3f}\n"
            f"\tmin: {min(gaps):.3f}s max: {max(gaps):.3f}s std dev: {deviation:.5f}s "
            f"window: {len(gaps) + 1}"
        )


def measure(client: RosClient, options: argparse.Namespace) -> None:
    """Print the rate of a topic once a second."""
    subscriber, rate = _subscribe(client, options), Rate()
    end_ns = None if options.for_ns is None else client.now_ns + options.for_ns
    next_ns, before = client.now_ns + NS_PER_S, 0
    while end_ns is None or client.now_ns < end_ns:
        client.step()
        while subscriber.pop_raw() is not None:
            rate.add(client.now_ns)
        if client.now_ns >= next_ns:
            next_ns += NS_PER_S
            pushed = subscriber.queue.pushed
            _print(str(rate) if pushed > before else "no new messages")
            before = pushed


def publish(client: RosClient, options: argparse.Namespace) -> None:
    """Publish a message: latched, or so many times a second."""
    client.call_master("getUri")  # without a master nobody would ever hear
    message_type = client.types.message(options.type)
    message = message_of(client.types, message_type, options.value)
    topic = client.settings.names.resolve(options.topic)
    publisher = client.node.register_publisher(
        topic, message_type.name, latching=options.rate is None, queue_size=QUEUE
    )
    client.wait(lambda: publisher.subscribers, ONCE_NS)
    if options.rate is not None:
        _repeat(client, publisher, message, int(NS_PER_S / options.rate))
        return
    publisher.send(message)
    _print(f"{CALLER[1:]}: publishing {topic}, latched" + ("" if options.once else "; Ctrl-C ends"))
    client.wait(lambda: False, ONCE_NS if options.once else None)


def _repeat(client: RosClient, publisher: Publisher, message: Message, period_ns: int) -> None:
    next_ns = client.now_ns
    while True:
        client.wait_until(next_ns)
        publisher.send(message)
        next_ns += period_ns


def message_of(types: MessageTypes, message_type: MessageType, text: str) -> Message:
    """Return the message that JSON, or YAML in one line, stands for.

    A value alone is that of the only field.

    Raises:
        MessageValueError: it is not such a message.
    """
    try:
        value: Any = json.loads(text)
    except (ValueError, RecursionError):
        value = _typed(message_type, text)
    if not isinstance(value, dict) and len(message_type.fields) == 1:
        value = {message_type.fields[0].name: value}
    return from_json(types, message_type, value)


def _typed(message_type: MessageType, text: str) -> Any:
    """Return what a text that is no JSON stands for: fields in braces, a list, or itself."""
    if text.strip()[:1] not in ("{", "["):
        return text
    fields = message_type.fields
    is_text = len(fields) == 1 and fields[0].base == "string" and not fields[0].is_array
    try:
        value = parse_flow(text)
    except (ValueError, RecursionError) as error:
        if is_text:
            return text
        raise MessageValueError(f"{message_type.name}: {error}.") from error
    return text if is_text and not isinstance(value, dict) else value


topic_list = acting(list_topics)
topic_info = acting(tell_topic)
topic_echo = acting(echo)
topic_hz = acting(measure)
topic_pub = acting(publish)
