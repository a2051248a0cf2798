"""The functions of CrosNode as programs in Structured Text and C call them, by numbers."""

import struct
from typing import Any

from crosnode.interface import fields, messages, nodes, params
from crosnode.interface.interface import (
    CrosMessageType,
    CrosNodeNews,
    crosERR_CUT,
    crosERR_FIELD,
    crosERR_HANDLE,
    crosERR_REFUSED,
    crosERR_STRUCT,
    crosERR_VALUE,
)
from crosnode.node.status import StatusKind
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE
from st_types.types.values import decode
from st_types.types.views import type_of

from ..node.world import drain
from .site import Site

POINTS = "trajectory_msgs/JointTrajectory"


def test_a_name_brings_its_namespace(site: Site) -> None:
    site.world.until(lambda: nodes.is_registered(site.context, site.node))
    call = site.other.call_master("lookupNode", "/cell/plc")
    site.world.until(lambda: call.was_answered)
    assert call.value


def test_a_message_is_filled_field_by_field_and_read_so(site: Site) -> None:
    context = site.context
    out = site.publisher("/out", POINTS)
    heard = site.other.register_subscriber("/out", POINTS)
    site.world.until(lambda: nodes.peers(context, out))
    msg = messages.new_message(context, out)
    points = site.field(msg, "points")
    assert fields.set_array_size(context, points, 2) == 0
    assert fields.array_size(context, points) == 2
    positions = site.field(msg, "points[1].positions")
    assert fields.set_array_size(context, positions, 6) == 0
    assert fields.set_real(context, positions, 5, 1.5) == 0
    assert fields.set_int(context, site.field(msg, "points[1].time_from_start"), 0, 10**9 + 5) == 0
    names = site.field(msg, "joint_names")
    fields.set_array_size(context, names, 1)
    assert fields.set_string(context, names, 0, site.text("shoulder")) == 0
    assert fields.get_real(context, positions, 5) == 1.5
    assert fields.type_of_field(context, names) == CrosMessageType.CROS_STD_MSGS_STRING.value
    assert messages.send(context, out, msg) == 0
    site.world.run(10)
    (message,) = drain(heard.pop)
    assert list(message.points[1].positions) == [0, 0, 0, 0, 0, 1.5]
    assert message.points[1].time_from_start.to_ns() == 10**9 + 5
    assert message.joint_names == ["shoulder"]
    assert messages.send(context, out, msg) == crosERR_HANDLE  # it is released
    assert fields.get_int(context, positions, 0) == 0


def test_what_does_not_fit_has_a_status(site: Site) -> None:
    context = site.context
    out = site.publisher("/out", "std_msgs/UInt8")
    msg = messages.new_message(context, out)
    data = site.field(msg, "data")
    assert fields.set_int(context, data, 0, 256) == crosERR_VALUE
    assert fields.set_real(context, data, 0, float("nan")) == crosERR_VALUE
    assert fields.set_int(context, data, 0, 255) == 0
    assert fields.get_int(context, data, 0) == 255
    assert fields.set_string(context, data, 0, site.text("x")) == crosERR_FIELD
    assert fields.set_array_size(context, data, 3) == crosERR_FIELD
    assert fields.array_size(context, data) == -1
    assert site.field(msg, "nothing") == site.field(msg, "data.more") == site.field(msg, "") == 0
    assert messages.free(context, msg) == 0
    assert messages.free(context, msg) == crosERR_HANDLE


def test_a_type_or_a_name_that_is_none_gives_no_handle(site: Site) -> None:
    assert site.publisher("/out", "std_msgs/Nothing") == 0
    assert site.publisher("not a name", "std_msgs/String") == 0
    assert nodes.create(site.context, site.text("not a name")) == 0
    assert nodes.do_events_loop(site.context, 99) == crosERR_HANDLE


def test_received_messages_need_no_release(site: Site) -> None:
    context = site.context
    heard = site.subscriber("/in", "std_msgs/String")
    source = site.other.register_publisher("/in", "std_msgs/String")
    site.world.until(lambda: source.subscribers)
    handles = set()
    for number in range(50):
        source.send(source.new(data=f"word {number}"))
        site.world.run(3)
        msg = messages.next_message(context, heard)
        handles.add(msg)
        place = site.area(5)
        status = fields.get_string(context, site.field(msg, "data"), 0, place, 5)
        assert (status, site.string(place)) == (crosERR_CUT, "word")
    assert messages.next_message(context, heard) == 0
    assert len(handles) == 50
    from crosnode.interface.handles import handles_of

    assert len(handles_of(context)._idents) < 5


def test_a_service_is_answered_and_called(site: Site) -> None:
    context, world = site.context, site.world
    type_name = site.text("std_srvs/SetBool")
    ours = nodes.register_provider(context, site.node, site.text("/ours"), type_name)
    caller = site.other.register_service_caller("/ours", "std_srvs/SetBool")
    world.run(50)  # the master knows the service
    caller.call(caller.new(data=True))
    request = 0
    for _ in range(200):
        world.run(1)
        request = request or messages.next_message(context, ours)
    assert fields.get_int(context, site.field(request, "data"), 0) == 1
    response = messages.new_message(context, request)
    fields.set_int(context, site.field(response, "success"), 0, 1)
    fields.set_string(context, site.field(response, "message"), 0, site.text("done"))
    assert messages.send(context, request, response) == 0
    world.run(5)
    (reply,) = drain(caller.pop)
    assert (reply.response.success, reply.response.message) == (True, "done")

    theirs = site.other.register_service_provider("/theirs", "std_srvs/SetBool")
    own = nodes.register_caller(context, site.node, site.text("/theirs"), type_name, False)
    world.run(100)
    for answer in (True, False):
        assert messages.send(context, own, messages.new_message(context, own)) == 0
        asked: list[Any] = []
        world.until(lambda asked=asked: asked.extend(drain(theirs.pop)) or asked)  # type: ignore[misc]
        if answer:
            asked[0].respond(success=True)
        else:
            asked[0].fail("no")
        world.run(20)
        got = messages.next_message(context, own)
        place = site.area(20)
        expected = (0, "") if answer else (crosERR_REFUSED, "no")
        assert (messages.error_of(context, got, place, 20), site.string(place)) == expected


def test_parameters_are_followed_asked_for_and_set(site: Site) -> None:
    context = site.context
    speed = nodes.subscribe_param(context, site.node, site.text("/speed"))
    setter = context.memory.new(params.cRosApiSetParam, context)
    getter = context.memory.new(params.cRosApiGetParam, context)
    setter(enable=True, node=site.node, key="/speed", value="2.5")
    assert setter.status == ERR_FUB_BUSY
    while setter.status == ERR_FUB_BUSY:
        setter()
        site.world.run(1)
    assert setter.status == 0
    assert params.real(context, speed) == 2.5
    assert params.has_changed(context, speed)
    while params.has_changed(context, speed):
        pass
    place = site.area(10)
    assert params.text(context, speed, place, 10) == 0
    assert site.string(place) == "2.5"
    getter(enable=True, node=site.node, key="/nothing")
    while getter.status == ERR_FUB_BUSY:
        getter()
        site.world.run(1)
    assert getter.status == crosERR_REFUSED
    getter(enable=False)
    assert getter.status == ERR_FUB_ENABLE_FALSE


def test_news_and_time_are_written_to_their_structs(site: Site) -> None:
    context = site.context
    site.world.until(lambda: nodes.is_registered(context, site.node))
    news_type = type_of(CrosNodeNews)
    place = site.area(news_type.size)
    kinds = []
    while nodes.pop_status(context, site.node, place):
        kinds.append(decode(news_type, context.memory.read(place, news_type.size))["kind"])
    assert StatusKind.MASTER_FOUND.value in [int(kind) for kind in kinds]
    clock = site.area(8)
    nodes.time(context, site.node, clock)
    sec, nsec = struct.unpack("<II", context.memory.read(clock, 8))
    assert sec >= 0
    assert nsec < 10**9


def test_an_address_where_no_struct_lies_is_refused(site: Site) -> None:
    out = site.publisher("/out", "std_msgs/String")
    msg = messages.new_message(site.context, out)
    place = site.area(8)
    assert messages.from_struct(site.context, msg, place, 8) == crosERR_STRUCT
    assert messages.to_struct(site.context, msg, place, 8) == crosERR_STRUCT


def test_a_destroyed_node_takes_its_handles_with_it(site: Site) -> None:
    out = site.publisher("/out", "std_msgs/String")
    assert nodes.destroy(site.context, site.node) == 0
    assert messages.new_message(site.context, out) == 0
    assert nodes.unregister(site.context, out) == crosERR_HANDLE
