"""A controller whose programs call the functions of CrosNode, and a node on another host."""

from __future__ import annotations

from typing import TYPE_CHECKING

from crosnode.interface import fields, nodes

from ..node.world import OTHER_IP, PLC_IP, World

if TYPE_CHECKING:
    import pytest

    from crosnode.node import CrosNode


class Site:
    """A controller's context, and a node on another host."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.world = World()
        monkeypatch.setenv("ROS_MASTER_URI", self.world.master_uri)
        monkeypatch.setenv("ROS_IP", PLC_IP)
        self.context = self.world.context(PLC_IP)
        self.other: CrosNode = self.world.node("other", OTHER_IP)
        self.node = nodes.create(self.context, self.text("/cell/plc"))
        assert self.node
        self.world.steps.append(lambda: nodes.do_events_loop(self.context, self.node))

    def text(self, text: str) -> int:
        return self.context.memory.keep(text.encode("latin-1") + b"\0", 1)

    def area(self, size: int) -> int:
        return self.context.memory.keep(bytes(size), 8)

    def string(self, address: int) -> str:
        return self.context.memory.string(address, 300).decode("latin-1")

    def field(self, msg: int, path: str) -> int:
        return fields.get_field(self.context, msg, self.text(path))

    def publisher(self, topic: str, type_name: str) -> int:
        return nodes.register_publisher(
            self.context, self.node, self.text(topic), self.text(type_name), -1, False
        )

    def subscriber(self, topic: str, type_name: str) -> int:
        return nodes.register_subscriber(
            self.context, self.node, self.text(topic), self.text(type_name), 10
        )
