"""Message classes: attributes, defaults, equality."""

import numpy as np
import pytest

from crosnode.errors import DefinitionError
from crosnode.messages.values import Duration, Time

from .test_codec import codec_of, new


def test_defaults() -> None:
    codec = codec_of(Inner="int32 x")
    message = new(
        codec,
        """
        bool b
string s
float32 f
uint8 u
time t
duration d
Inner i
        float64[3] fixed
uint8[] bytes
Inner[2] two
Inner[] some
string[2] words
time[] times
        """,
    )
    assert (message.b, message.s, message.f, message.u) == (False, "", 0.0, 0)
    assert (message.t, message.d) == (Time(0, 0), Duration(0, 0))
    assert message.i.x == 0
    assert message.fixed.tolist() == [0.0, 0.0, 0.0]
    assert message.bytes.tolist() == []
    assert [inner.x for inner in message.two] == [0, 0]
    assert message.two[0] is not message.two[1]
    assert (message.some, message.words, message.times) == ([], ["", ""], [])
    data = codec.encode("pkg/Type", message)
    assert codec.decode("pkg/Type", data) == message


def test_defaults_are_not_shared() -> None:
    codec = codec_of(Type="int32[] a\nstring[] b")
    first, second = (codec.decode("pkg/Type", bytes(8)) for _ in range(2))
    first.b.append("x")
    assert second.b == []


def test_keyword_that_collides() -> None:
    with pytest.raises(DefinitionError, match="from_"):
        codec_of(Type="int32 from\nint32 from_")


def test_equality() -> None:
    codec = codec_of(Type="float64[] x\nint32 y", Other="float64[] x\nint32 y")
    one, two = (codec.decode("pkg/Type", bytes(8)) for _ in range(2))
    assert one == two
    two.x = np.array([1.0])
    assert one != two
    assert one != codec.decode("pkg/Other", bytes(8))
    assert repr(one) == "Type(x=array([], dtype=float64), y=0)"
    with pytest.raises(TypeError):
        hash(one)


def test_a_field_may_have_any_name() -> None:
    codec = codec_of()
    message = new(
        codec, "int8 self\nint8 cls\nint8 f\nstring[] d\nint8 from", f=3, d=["x"], from_=4
    )
    assert repr(message) == "Type(self=0, cls=0, f=3, d=['x'], from_=4)"
    with pytest.raises(TypeError, match="unexpected keyword argument 'g'"):
        type(message)(g=1)
