"""Values as people type them for rostopic."""

import json
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.graph.flow_yaml import parse_flow


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("{a: 1, b: [1.5, -2e3, .5]}", {"a": 1, "b": [1.5, -2000.0, 0.5]}),
        (
            "{ names: [joint_1, joint 2 ,j3 ] , n : {} }",
            {"names": ["joint_1", "joint 2", "j3"], "n": {}},
        ),
        ("{a: it is, b: 'it''s', c: \"a\\nb\"}", {"a": "it is", "b": "it's", "c": "a\nb"}),
        ("{uri: http://a:1/, t: 12:30}", {"uri": "http://a:1/", "t": "12:30"}),
        ("{a: True, b: false, c: ~, d: null}", {"a": True, "b": False, "c": None, "d": None}),
        ("{x: .nan, y: -.inf, z: '.nan'}", {"x": "NaN", "y": "-Infinity", "z": ".nan"}),
        ("{y: 1, 2: a, true: b}", {"y": 1, "2": "a", "true": "b"}),
        ("[{a: 1}, {b: [[], [x]]},]", [{"a": 1}, {"b": [[], ["x"]]}]),
        ("{'a b': 1}", {"a b": 1}),
        ("  3 ", 3),
    ],
)
def test_what_is_typed(text: str, value: object) -> None:
    assert parse_flow(text) == value


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{a: 1", "expected ',' or '}' at character 6, got the end"),
        ("{a 1}", "expected ':' at character 5, got '}'"),
        ("{a:}", "expected a value at character 4, got '}'"),
        ("[1 {", "expected ',' or ']' at character 4, got '{'"),
        ("[1] x", "expected the end at character 5, got 'x'"),
        ("['a", 'expected a value at character 2, got "\'a"'),
        ("", "expected a value at character 1, got the end"),
        ('{a: "b}', "Unterminated string"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(text: str, said: str) -> None:
    with pytest.raises(ValueError, match="^" + said.replace("[", r"\[").replace("{", r"\{")):
        parse_flow(text)


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**17), 10**17) | st.floats(-1e9, 1e9) | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
)


@given(VALUES)
def test_json_is_read_as_json(value: object) -> None:
    assert parse_flow(json.dumps(value)) == value


@given(st.text(alphabet="{}[],:'\" ab1.-\\#"))
def test_any_text_has_a_value_or_is_wrong(text: str) -> None:
    with suppress(ValueError):
        assert parse_flow(text) == parse_flow(f" {text} ")
