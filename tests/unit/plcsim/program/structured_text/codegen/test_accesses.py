import pytest

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.accesses import (
    MOST_COMPARED,
    PARTS,
    Effects,
    loop_accesses,
    nodes_of,
    roots_given,
    roots_of,
)
from plcsim.program.structured_text.codegen.places import key_of

from .build import (
    address,
    call,
    evaluate,
    function,
    if_,
    load,
    module,
    number,
    op,
    place,
    store,
    unit,
)

FOREIGN = {
    "fb": ir.Import("block", "FB", ir.Signature(("i32",), None)),
    "f": ir.Import("function", "f", ir.Signature(("i32",), "i32")),
}


def key(offset, width="w32", root=None):
    return key_of(place(offset, root), width, this=False)


def test_every_kind_of_node_is_known():
    kinds = set(ir.Expression.__args__) | set(ir.Statement.__args__)
    assert set(PARTS) == kinds


def test_all_nodes_are_found():
    inner = load(8)
    case = ir.Case(1, [(0, 0)], [store(0, inner)])
    tree = [
        ir.Loop(1, 1, [ir.Switch(1, load(4), [case], [ir.Block(1, 2, [ir.Break(1, 2)])])]),
        ir.CopyBytes(1, address(0), address(4), number(3)),
        ir.FillBytes(1, address(0), number(0), load(12)),
        if_(load(16), [ir.Return(1, load(20))], [ir.Return(1)]),
        evaluate(ir.StatementExpression("i32", [store(0, 1)], ir.Checked(load(24), 3))),
        evaluate(
            ir.Select("i32", load(28), load(32), ir.IfExpression("i32", load(36), inner, inner))
        ),
        ir.SetLocal(1, 0, ir.Convert("i64", "extend_i32_s", ir.Unary("i32", "clz", load(40)))),
    ]
    offsets = {n.place.offset for n in nodes_of(tree) if type(n) is ir.Load}
    assert offsets == set(range(4, 44, 4))


def test_roots_behind_addresses():
    assert roots_of(address(4, 7)) == {7}
    assert roots_of(load(4)) == {0}
    assert roots_of(op("add", address(4, 7), load(0))) == {0, 7}
    given = call("f", address(0, 5), load(0), number(4), ir.Const("f64", 1.0), load(0, "f64"))
    assert roots_given(given) == {5, 0}


def effects(*functions):
    return Effects(module(*functions, imports=FOREIGN))


def test_a_call_changes_what_the_function_and_its_callees_store():
    found = effects(
        function("a", (), None, store(0, 1, root=3), evaluate(call("b"))),
        function("b", (), None, store(4, load(8, root=9), root=4), evaluate(call("a"))),
        function("c", (), None, evaluate(call("b"))),
    )
    assert found.of_call(call("c")) == {3, 4}
    assert found.calls_of("c") == {"b"}
    assert found.of_call(call("a", address(0, 6))) == {3, 4, 6}


def test_an_import_changes_what_is_not_known_and_its_arguments():
    found = effects(unit())
    assert found.of_call(call("fb", address(0, 6))) == {0, 6}
    assert found.of_call(call("f", number(3), result="i32")) == {0}


def test_helpers_change_their_target_only():
    found = effects(unit())
    assigned = call("rt.string_assign", address(0, 6), address(8, 7), number(8))
    assert found.of_call(assigned) == {6}
    assert found.of_call(call("rt.string_compare", address(0, 6), address(8, 7))) == set()
    assert found.of_call(call("rt.sin", load(0, "f64"), result="f64")) == set()


def test_bytes_and_helpers_inside_functions_count():
    found = effects(
        function(
            "a",
            (),
            None,
            ir.CopyBytes(1, address(0, 3), address(0, 4), number(100)),
            ir.FillBytes(1, load(0, root=5), number(0), number(1)),
            evaluate(call("rt.string_assign", address(0, 6), address(8, 7), number(8))),
        )
    )
    assert found.of_function("a") == {0, 3, 6}


def accesses(*body, this=False, functions=()):
    loop = ir.Loop(1, 1, body)
    return loop_accesses(loop, effects(*functions, unit(loop)), this=this)[id(loop)]


def test_a_loop_keeps_what_nothing_else_changes():
    found = accesses(
        store(0, op("add", load(0), load(4))),
        store(8, load(12, root=0), root=0),
        evaluate(call("f", load(16), result="i32")),
    )
    assert set(found.loaded) == {key(0), key(4), key(12, root=0), key(16)}
    kept = [k for k in found.loaded if not found.changes(k)]
    assert set(kept) == {key(0), key(4), key(16)}


@pytest.mark.parametrize(
    ("other", "changes"), [(store(3, 1, "u8", root=9), True), (store(4, 1, "u8", root=9), False)]
)
def test_a_store_to_a_part_changes_the_whole(other, changes):
    assert accesses(evaluate(load(0, root=9)), other).changes(key(0, root=9)) == changes


def test_a_store_to_an_element_changes_all_of_the_array():
    element = ir.Place(op("add", address(0, 9), load(100)), 0, 9)
    found = accesses(ir.Store(1, "w32", element, load(0, root=9)))
    assert found.changes(key(0, root=9))
    assert not found.changes(key(100))


def test_inner_loops_count_more():
    inner = ir.Loop(1, 2, [store(0, op("add", load(0), load(4)))])
    found = accesses(evaluate(load(8)), inner)
    assert found.loaded[key(4)][1] > found.loaded[key(8)][1]
    assert key(0).root in found.stored


def test_many_places_of_one_variable_are_taken_as_one():
    stores = [store(4 * n, 1, root=9) for n in range(MOST_COMPARED + 1)]
    assert accesses(*stores).changes(key(4000, root=9))


def test_in_a_block_addresses_may_reach_its_data():
    pointer = ir.Store(1, "w32", ir.Place(load(0), 0, 0), number(1))
    found = accesses(pointer, this=True)
    assert found.changes(key(8, root=5))
    global_ = accesses(store(0, 1, root=0), this=True)
    member = key_of(ir.Place(ir.Local("i32", 0), 8, 5), "w32", this=True)
    assert global_.changes(member)
    assert accesses(pointer).changes(key(8, root=5)) is False
