"""Names and namespaces."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.errors import InvalidNameError
from crosnode.graph.names import (
    NodeNames,
    canonical,
    check_base_name,
    check_name,
    join,
    namespace_of,
)


@pytest.mark.parametrize("name", ["a", "/a", "~a", "~", "/", "a/b_1", "/a//b", "A9"])
def test_legal(name: str) -> None:
    assert check_name(name) == name


@pytest.mark.parametrize(
    "name", ["", "1a", "_a", "a b", "a-b", "a~b", "/~a", "é", "a\n", "a:b", "a.b"]
)
def test_illegal(name: str) -> None:
    with pytest.raises(InvalidNameError, match="is not a ROS name"):
        check_name(name)


@pytest.mark.parametrize("name", ["/a", "~a", "a/b", ""])
def test_base_names_have_no_namespace(name: str) -> None:
    with pytest.raises(InvalidNameError, match="without namespace"):
        check_base_name(name)


def test_parts() -> None:
    assert canonical("//a///b/") == "/a/b"
    assert canonical("/") == "/"
    assert join("/", "a") == "/a"
    assert join("/ns", "a/b") == "/ns/a/b"
    assert join("/ns", "/a") == "/a"
    assert namespace_of("/a") == "/"
    assert namespace_of("/a/b") == "/a"


@pytest.mark.parametrize(
    ("name", "resolved"),
    [
        ("chatter", "/ns/chatter"),
        ("/chatter", "/chatter"),
        ("~chatter", "/ns/node/chatter"),
        ("~/chatter", "/ns/node/chatter"),
        ("~", "/ns/node"),
        ("a//b/", "/ns/a/b"),
        ("/", "/"),
    ],
)
def test_resolve(name: str, resolved: str) -> None:
    assert NodeNames("/ns/node", "/ns", {}).resolve(name) == resolved


@given(st.text("ab/~_0 "), st.text("ab/"))
def test_resolved_names_are_global_and_stay(name: str, namespace: str) -> None:
    names = NodeNames(join(f"/{namespace}", "node"), canonical(f"/{namespace}"), {})
    try:
        resolved = names.resolve(name)
    except InvalidNameError:
        return
    assert resolved.startswith("/")
    assert "//" not in resolved
    assert names.resolve(resolved) == resolved
