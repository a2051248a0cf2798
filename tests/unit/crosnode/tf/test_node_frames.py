"""Broadcasters and a listener on two nodes of a virtual network."""

import pytest

from crosnode.errors import MessageValueError, TransformError
from crosnode.node.ros_time import Epoch
from crosnode.tf import node_frames
from crosnode.tf.node_frames import (
    StaticTransformBroadcaster,
    TransformBroadcaster,
    TransformListener,
)
from crosnode.tf.transform import Transform

from ..node.world import OTHER_IP, World, drain

EPOCH_NS = 10**18


def world_with_frames() -> tuple[World, TransformBroadcaster, StaticTransformBroadcaster]:
    world = World()
    node = world.node("arm", epoch=Epoch(EPOCH_NS))
    return world, TransformBroadcaster(node), StaticTransformBroadcaster(node)


def test_frames_are_told_and_looked_up() -> None:
    world, moving, static = world_with_frames()
    static.send("world", "base", Transform((0.0, 0.0, 1.0)))
    static.send("base", "camera", Transform((0.0, 0.0, 2.0)))
    world.run(100)
    listener = TransformListener(world.node("late", OTHER_IP, epoch=Epoch(EPOCH_NS)))
    world.steps.append(listener.step)
    world.run(100)
    assert listener.lookup("world", "camera").translation == (0.0, 0.0, 3.0)
    with pytest.raises(TransformError):
        listener.lookup("world", "hand")
    moving.add("base", "hand", Transform((1.0, 0.0, 0.0)))
    moving.add("base", "foot", Transform((0.0, 5.0, 0.0)), stamp_ns=EPOCH_NS)
    moving.send()
    moving.send()  # nothing was added
    sent_ns = EPOCH_NS + world.now_ns
    world.run(20)
    assert listener.lookup("world", "hand", sent_ns).translation == (1.0, 0.0, 1.0)
    assert listener.buffer.frames["foot"].history[0].stamp_ns == EPOCH_NS


def test_who_comes_late_hears_the_static_frames_of_all_broadcasters_of_a_node() -> None:
    world, _, static = world_with_frames()
    other = StaticTransformBroadcaster(static._node)
    static.send("world", "base", Transform((0.0, 0.0, 1.0)))
    other.send("base", "tool", Transform())
    static.send("world", "base", Transform((0.0, 0.0, 2.0)))
    static.send("base", "camera", Transform())
    listener = TransformListener(world.node("late", OTHER_IP, epoch=Epoch(EPOCH_NS)))
    world.steps.append(listener.step)
    world.run(200)
    assert set(listener.buffer.frames) == {"base", "tool", "camera"}
    assert listener.lookup("world", "tool").translation == (0.0, 0.0, 2.0)


def test_one_message_for_all_frames_of_a_cycle_and_one_publisher_for_all_broadcasters() -> None:
    world, moving, _ = world_with_frames()
    again = TransformBroadcaster(moving._node)
    listener = world.node("l", OTHER_IP).register_subscriber("/tf", "tf2_msgs/TFMessage")
    world.run(200)
    for child in ("a", "b", "a"):
        moving.add("base", child, Transform())
    moving.send()
    again.add("base", "c", Transform())
    again.send()
    world.run(20)
    names = [[each.child_frame_id for each in m.transforms] for m in drain(listener.pop)]
    assert names == [["a", "b"], ["c"]]


def test_what_peers_send_that_is_no_transform_is_counted() -> None:
    world = World()
    node = world.node("n", epoch=Epoch(EPOCH_NS))
    listener = TransformListener(node)
    peer = world.node("peer", OTHER_IP).register_publisher("/tf", "tf2_msgs/TFMessage")
    world.run(200)
    empty = node.types.message("geometry_msgs/TransformStamped").new()
    peer.send(peer.new(transforms=[empty]))
    world.run(20)
    listener.step()
    assert listener.buffer.refused == 1
    assert not listener.buffer.frames


def test_time_that_goes_back_makes_what_moves_unknown() -> None:
    world, moving, static = world_with_frames()
    epoch = Epoch(EPOCH_NS)
    listener = TransformListener(world.node("l", OTHER_IP, epoch=epoch))
    world.steps.append(listener.step)
    world.run(200)
    static.send("base", "camera", Transform())
    moving.add("base", "hand", Transform())
    moving.send()
    world.run(20)
    assert set(listener.buffer.frames) == {"hand", "camera"}
    epoch.ns -= 10**15
    world.run(2)
    assert set(listener.buffer.frames) == {"camera"}


def test_too_many_static_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(node_frames, "MOST_STATIC", 2)
    _, _, static = world_with_frames()
    for child in ("a", "b", "a"):
        static.send("base", child, Transform())
    with pytest.raises(MessageValueError, match="more than 2"):
        static.send("base", "c", Transform())
