"""Messages as YAML, as rostopic echo prints them."""

from crosnode.messages import MessageTypes
from crosnode.messages.yaml_text import to_yaml


def test_every_kind_of_field() -> None:
    types = MessageTypes()
    types.define("x/Inner", "int8 a\nstring[] b\n")
    types.define("x/Nothing", "")
    found = types.define(
        "x/All",
        "time t\nfloat64[] f\nInner one\nInner[] many\nInner[] none\nNothing n\nNothing[] m\n"
        "bool b\n",
    )
    inner = types.message_class("x/Inner")
    nothing = types.message_class("x/Nothing")
    message = found.new(
        f=[1.5, float("nan")],
        many=[inner(1, ["x"]), inner(2, ['"'])],
        m=[nothing()],
        b=True,
    )
    message = found.decode(found.encode(message))
    assert to_yaml(types, found, message) == (
        't:\n  secs: 0\n  nsecs: 0\nf: [1.5, "NaN"]\n'
        "one:\n  a: 0\n  b: []\n"
        'many:\n  - a: 1\n    b: ["x"]\n  - a: 2\n    b: ["\\""]\n'
        "none: []\nn: {}\nm:\n  - {}\nb: true\n"
    )


def test_bytes_that_are_not_utf8_are_escapes() -> None:
    types = MessageTypes()
    found = types.message("std_msgs/String")
    message = found.decode(b"\2\0\0\0\xe9a")
    assert to_yaml(types, found, message) == 'data: "\\udce9a"\n'
