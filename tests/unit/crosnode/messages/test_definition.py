"""What genmsg makes of a definition's text, line by line."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import DefinitionError, MessageTypeError
from crosnode.messages.definition import (
    Field,
    integer_range,
    md5_text,
    parse_message,
    split_parts,
    split_type_name,
)


def text_for_md5(text: str) -> str:
    return md5_text(parse_message("pkg/Type", text), lambda name: f"<{name}>")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", ""),
        ("# only a comment\n   # indented\n \t \n", ""),
        ("int32   x", "int32 x"),
        ("  int32 x  # why", "int32 x"),
        ("int32 x\t# tab before", "int32 x"),
        ("int32 x\r\nint32 y\r\n", "int32 x\nint32 y"),
        ("int32[] x\nuint8[07] y", "int32[] x\nuint8[07] y"),
        ("time t\nduration[2] d", "time t\nduration[2] d"),
        ("other/Name[] a\nName b", "<other/Name> a\n<pkg/Name> b"),
        ("Header header\nstd_msgs/Header h", "<std_msgs/Header> header\n<std_msgs/Header> h"),
        ("int32 x\nint32 A=1", "int32 A=1\nint32 x"),
        ("int32  A =  1  # one", "int32 A=1"),
        (
            "float32 A=1e-3\nfloat64 B=1.50\nfloat64 C=3",
            "float32 A=1e-3\nfloat64 B=1.50\nfloat64 C=3",
        ),
        ("uint8 A=017\nint8 B=+5", "uint8 A=017\nint8 B=+5"),
        ("string A=hello # not a comment", "string A=hello # not a comment"),
        ("string A = x=y ", "string A=x=y"),
        ("string A=", "string A="),
        ('string A="quoted"', 'string A="quoted"'),
        ("  string A=x", "string string A=x"),
        ("string kFoo=007", "string kFoo=007"),
        ("bool A=True\nbool b_=0", "bool A=True\nbool b_=0"),
        ("int32 x # a=b", "int32 x"),
        ("int32 1x y=1\nint32 =2", "int32 1x y=1\nint32 =2"),
    ],
)
def test_md5_text(text: str, expected: str) -> None:
    assert text_for_md5(text) == expected


@pytest.mark.parametrize(
    ("line", "value"),
    [
        ("float32 A=1e-3", 1e-3),
        ("string A= a # b ", "a # b"),
        ("  string A=x", "x"),
        ("uint8 A=017", 17),
        ("byte A=-128", -128),
        ("char A=255", 255),
        ("int64 A=-9223372036854775808", -(2**63)),
        ("bool A=True", True),
        ("bool A=0", False),
    ],
)
def test_constant_value(line: str, value: object) -> None:
    (constant,) = parse_message("pkg/Type", line).constants
    assert constant.name == "A"
    assert constant.value == value
    assert type(constant.value) is type(value)


def test_fields() -> None:
    definition = parse_message("pkg/Type", "Name[3] a\nuint8[] b\nHeader h")
    assert definition.fields == (
        Field("a", "Name[3]", "pkg/Name", is_array=True, length=3),
        Field("b", "uint8[]", "uint8", is_array=True),
        Field("h", "Header", "std_msgs/Header"),
    )


@pytest.mark.parametrize(
    "line",
    [
        "int32",
        "int32 x y",
        "int32\tx",
        "int32 1x",
        "int32 x-y",
        "int32[ x",
        "int32[-1] x",
        "int32[][] x",
        "int32[<=3] x",
        "a/b/c x",
        "../x y",
        "int32[999999999] x",
        "int32 A=",
        "int32 A=1=2",
        "int32 A=x",
        "uint8 A=256",
        "byte A=128",
        "bool A=yes",
        "float32 A=one",
        "time A=1",
        "Name A=1",
        "int32 é",
        "int32 x\nfloat32 x",
    ],
)
def test_refused(line: str) -> None:
    with pytest.raises(DefinitionError, match="pkg/Type"):
        parse_message("pkg/Type", line)


def test_error_names_the_line() -> None:
    with pytest.raises(DefinitionError, match=r"pkg/Type, line 3: expected 'type name'"):
        parse_message("pkg/Type", "int32 x\n# fine\nbroken")


@given(st.text(alphabet=st.sampled_from("int32[]=#/ .\t\n\rAxé1-")))
def test_any_text_is_parsed_or_refused(text: str) -> None:
    try:
        definition = parse_message("pkg/Type", text)
    except DefinitionError:
        return
    for field in definition.fields:
        assert field.name.isidentifier()
        assert field.name.isascii()


def test_type_names() -> None:
    assert split_type_name("std_msgs/String") == ("std_msgs", "String")
    assert split_type_name("std_msgs/msg/String") == ("std_msgs", "String")
    assert split_type_name("std_srvs/srv/Empty") == ("std_srvs", "Empty")


@pytest.mark.parametrize(
    "name", ["", "String", "a/b/c", "../String", "a/..", "a/B ", "/a/B", "a//B", "é/B", "a/B\n"]
)
def test_not_a_type_name(name: str) -> None:
    with pytest.raises(MessageTypeError, match="not a type name"):
        split_type_name(name)


def test_service_parts() -> None:
    assert split_parts("p/S", "int32 a\n---\nint32 b", 2) == ("int32 a\n", "int32 b\n")
    assert split_parts("p/S", "---", 2) == ("", "")
    assert split_parts("p/S", "int32 a", 2) == ("int32 a\n", "")
    assert split_parts("p/S", "# not --- here\n---  \r\nint32 b", 2) == (
        "# not --- here\n",
        "int32 b\n",
    )
    assert split_parts("p/S", "int32 a\n---\nint32 b\n---\nint32 c", 2) == (
        "int32 a\n",
        "int32 b\nint32 c\n",
    )


def test_action_parts() -> None:
    assert split_parts("p/A", "---\nint32 b\n---", 3) == ("", "int32 b\n", "")
    with pytest.raises(DefinitionError, match="2 parts"):
        split_parts("p/A", "---", 3)


def test_integer_range() -> None:
    assert integer_range("byte") == (-128, 127)
    assert integer_range("char") == (0, 255)
    assert integer_range("uint64") == (0, 2**64 - 1)
    assert integer_range("int16") == (-32768, 32767)
