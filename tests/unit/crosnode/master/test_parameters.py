"""The parameter tree, and who is told of a change."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from crosnode.master.parameters import MAX_DEPTH, ParameterChange, ParameterTree, _size, changes_for


def tree_of(**values: object) -> ParameterTree:
    tree = ParameterTree(100_000)
    for name, value in values.items():
        tree.set("/" + name.replace("__", "/"), value)
    return tree


def test_values_and_namespaces() -> None:
    tree = tree_of(a__b=1, a__c__d="x", e=[1, {"f": 2}])
    assert tree.get("/a/b") == 1
    assert tree.get("/a/") == {"b": 1, "c": {"d": "x"}}
    assert tree.get("/") == {"a": {"b": 1, "c": {"d": "x"}}, "e": [1, {"f": 2}]}
    assert tree.names() == ["/a/b", "/a/c/d", "/e"]
    assert "/a" in tree
    assert "/a/b/c" not in tree
    assert "/e/f" not in tree


def test_set_replaces_all_that_was_there() -> None:
    tree = tree_of(a__b=1)
    tree.set("/a", {"c": 2})
    assert tree.get("/") == {"a": {"c": 2}}
    tree.set("/a/c/d", 3)
    assert tree.get("/") == {"a": {"c": {"d": 3}}}
    tree.set("/", {"x": 1})
    assert tree.names() == ["/x"]


def test_values_are_copies() -> None:
    value = {"b": [1]}
    tree = ParameterTree(1000)
    tree.set("/a", value)
    value["b"].append(2)
    tree.get("/a")["b"].append(3)
    assert tree.get("/a/b") == [1]


def test_delete() -> None:
    tree = tree_of(a__b=1, a__c=2)
    tree.delete("/a/b")
    assert tree.get("/") == {"a": {"c": 2}}
    for name in ("/a/b", "/a/c/d", "/", "/x"):
        with pytest.raises(KeyError):
            tree.delete(name)


@pytest.mark.parametrize(
    ("namespace", "key", "found"),
    [
        ("/pr2/foo", "robot", "/pr2/robot"),
        ("/pr2", "robot", "/pr2/robot"),
        ("/other/foo", "robot", "/robot"),
        ("/pr2/foo", "robot/none", "/pr2/robot/none"),
        ("/pr2/foo", "/robot/arm", "/robot/arm"),
        ("/pr2/foo", "/none", None),
        ("/pr2/foo", "none", None),
        ("/", "robot", "/robot"),
        ("/pr2/foo", "~robot", None),
        ("/pr2/foo", "", None),
    ],
)
def test_search(namespace: str, key: str, found: str | None) -> None:
    assert tree_of(robot__arm=1, pr2__robot__base=2).search(namespace, key) == found


def test_limits() -> None:
    tree = ParameterTree(1000)
    with pytest.raises(ValueError, match="more than 1000 bytes"):
        tree.set("/a", "x" * 1000)
    with pytest.raises(ValueError, match="keys within each other"):
        tree.set("/a" * MAX_DEPTH, 1)
    with pytest.raises(ValueError, match="root can only hold"):
        tree.set("/", 1)
    assert tree.get("/") == {}


NAMES = st.lists(st.sampled_from("abc"), min_size=1, max_size=3).map(
    lambda keys: "/" + "/".join(keys)
)
VALUES = st.recursive(
    st.integers() | st.text(max_size=3),
    lambda inner: st.dictionaries(st.sampled_from("abc"), inner, max_size=2),
    max_leaves=4,
)


@given(st.lists(st.tuples(NAMES, VALUES | st.none())))
def test_size_is_that_of_the_tree_after_any_acts(acts: list[tuple[str, object]]) -> None:
    tree = ParameterTree(10**6)
    for name, value in acts:
        if value is not None:
            tree.set(name, value)
            assert tree.get(name) == value
        elif name in tree:
            tree.delete(name)
            assert name not in tree
    assert tree._size == _size(tree._root) - _size({})


@pytest.mark.parametrize(
    ("subscribed", "name", "value", "changes"),
    [
        ("/p", "/p", 1, [ParameterChange("/p/", 1)]),
        ("/p", "/p/q", 1, [ParameterChange("/p/q/", 1)]),
        ("/", "/p/q", 1, [ParameterChange("/p/q/", 1)]),
        ("/p", "/pother", 1, []),
        ("/pother", "/p", {"x": 1}, []),
        ("/p/q", "/p", {"q": 1, "r": 2}, [ParameterChange("/p/q/", 1)]),
        ("/p/q/r", "/p", {"q": {"r": {"s": 1}}}, [ParameterChange("/p/q/r/", {"s": 1})]),
        ("/p/q", "/p", {"r": 2}, [ParameterChange("/p/q/", {})]),
        ("/p/q", "/p", 5, [ParameterChange("/p/q/", {})]),
        ("/p/q", "/p", {}, [ParameterChange("/p/q/", {})]),
        ("/p", "/", {"p": 1}, [ParameterChange("/p/", 1)]),
    ],
)
def test_changes(subscribed: str, name: str, value: object, changes: list[ParameterChange]) -> None:
    assert changes_for(subscribed, name, value) == changes
