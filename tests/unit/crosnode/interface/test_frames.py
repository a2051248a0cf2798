"""Frames by handles."""

import pytest

from crosnode.interface import frames
from crosnode.interface.interface import CrosTransform, crosERR_HANDLE, crosERR_NO_TRANSFORM
from crosnode.tf.node_frames import TransformBroadcaster, TransformListener
from crosnode.tf.transform import Transform
from st_types.types.values import decode, encode
from st_types.types.views import type_of

from .site import Site

LAYOUT = type_of(CrosTransform)


def put(site: Site, **values: float) -> int:
    address = site.area(LAYOUT.size)
    whole = dict.fromkeys(("x", "y", "z", "qx", "qy", "qz"), 0.0) | {"qw": 1.0} | values
    site.context.memory.write(address, encode(LAYOUT, whole))
    return address


def got(site: Site, address: int) -> dict[str, float]:
    value = decode(LAYOUT, site.context.memory.read(address, LAYOUT.size))
    assert isinstance(value, dict)
    return value


def test_frames_are_told_in_one_message_and_for_good(site: Site) -> None:
    listener = TransformListener(site.other)
    site.world.steps.append(listener.step)
    names = [site.text(name) for name in ("world", "base", "hand")]
    world, base, hand = names
    made = frames.broadcaster(site.context, site.node)
    assert frames.static(site.context, made, world, base, put(site, z=1.0)) == 0
    site.world.run(100)
    assert frames.broadcast(site.context, made, base, hand, put(site, x=2.0)) == 0
    assert frames.send(site.context, made) == 0
    site.world.run(20)
    assert listener.lookup("world", "hand") == Transform((2.0, 0.0, 1.0))


def test_what_others_tell_is_looked_up(site: Site) -> None:
    made = frames.listener(site.context, site.node)
    assert frames.listener(site.context, site.node) == 0  # it is one for a node
    teller = TransformBroadcaster(site.other)
    site.world.run(100)
    teller.add("base", "hand", Transform((0.5, 0.0, 0.0)))
    teller.send()
    site.world.run(20)
    address = put(site)
    base, hand = site.text("base"), site.text("hand")
    assert frames.lookup(site.context, made, base, hand, 0, address) == 0
    assert (got(site, address)["x"], got(site, address)["qw"]) == (0.5, 1.0)
    assert frames.lookup(site.context, made, hand, base, 0, address) == 0
    assert got(site, address)["x"] == -0.5
    before = got(site, address)
    nobody = site.text("nobody")
    answer = frames.lookup(site.context, made, base, nobody, 0, address)
    assert answer == crosERR_NO_TRANSFORM
    assert frames.lookup(site.context, made, base, hand, 1, address) == crosERR_NO_TRANSFORM
    assert got(site, address) == before


@pytest.mark.parametrize("handle", [0, 99])
def test_what_is_no_handle_is_refused(site: Site, handle: int) -> None:
    text, address = site.text("a"), put(site)
    assert frames.broadcaster(site.context, handle) == 0
    assert frames.listener(site.context, handle) == 0
    assert frames.broadcast(site.context, handle, text, text, address) == crosERR_HANDLE
    assert frames.send(site.context, handle) == crosERR_HANDLE
    assert frames.static(site.context, handle, text, text, address) == crosERR_HANDLE
    assert frames.lookup(site.context, handle, text, text, 0, address) == crosERR_HANDLE
