"""Runs under Debian's python3: answers one JSON question per line by genmsg and genpy."""

import io
import json
import sys
from importlib.util import find_spec

import genmsg
import roslib.message
from genmsg.gentools import compute_md5
from genmsg.msg_loader import MsgContext, load_depends, load_msg_from_string


def has_classes(package, suffix):
    try:
        return find_spec(f"{package}.{suffix}") is not None
    except ModuleNotFoundError:
        return False


def md5_of_text(text):
    context = MsgContext.create_default()
    load_msg_from_string(context, "string data", "other/Name")
    load_msg_from_string(context, "uint32 seq\ntime stamp\nstring frame_id", "std_msgs/Header")
    try:
        spec = load_msg_from_string(context, text, "pkg/Type")
        load_depends(context, spec, {})
        return compute_md5(context, spec)
    except (genmsg.InvalidMsgSpec, genmsg.MsgNotFound, ValueError, IndexError):
        return None


def message_facts(name):
    cls = roslib.message.get_message_class(name)
    if cls is None:
        return None
    buffer = io.BytesIO()
    cls().serialize(buffer)
    return {"md5": cls._md5sum, "text": cls._full_text, "default": buffer.getvalue().hex()}


def reserialized(name, data):
    cls = roslib.message.get_message_class(name)
    buffer = io.BytesIO()
    cls().deserialize(bytes.fromhex(data)).serialize(buffer)
    return buffer.getvalue().hex()


def service_md5(name):
    cls = roslib.message.get_service_class(name)
    return cls and [cls._md5sum, cls._request_class._md5sum, cls._response_class._md5sum]


for line in sys.stdin:
    function, *arguments = json.loads(line)
    print(json.dumps(globals()[function](*arguments)), flush=True)
