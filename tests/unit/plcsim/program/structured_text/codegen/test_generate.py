import pytest

from plcsim.core.memory import FIRST
from plcsim.machine.engine import compile_wasm
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.generate import generate

from .build import (
    PROGRAM,
    address,
    call,
    evaluate,
    function,
    load,
    module,
    number,
    op,
    program,
    store,
    unit,
)


def test_a_program_counts_its_cycles(compiled):
    machine = compiled(program(store(0, op("add", load(0, "u16"), 1), "u16")))
    for _ in range(3):
        machine.run()
    assert machine.read(FIRST, 2) == b"\3\0"


def test_only_what_is_exported_can_be_called(compiled):
    machine = compiled(module(unit(), function("INNER", (), None, exported=False)))
    assert "CYCLIC" in machine.instance
    assert "INNER" not in machine.instance


def test_what_is_imported_is_called_by_the_name_of_its_owner(compiled):
    calls = []
    imports = {
        "Blocks.TON": ir.Import("block", "TON", ir.Signature(("i32",), None)),
        "twice": ir.Import("function", "Twice", ir.Signature(("i32", "f64", "f32", "i64"), "i32")),
    }

    def block(_side, data):
        calls.append(data)

    def twice(_side, *given):
        calls.append(given)
        return given[0] * 2

    given = (number(4), ir.Const("f64", 1.5), ir.Const("f32", -2.0), ir.Const("i64", -7))
    body = (
        evaluate(call("Blocks.TON", address(8))),
        store(0, call("twice", *given, result="i32")),
    )
    machine = compiled(module(unit(*body), imports=imports), {"Blocks.TON": block, "twice": twice})
    machine.run()
    assert calls == [FIRST + 8, (4, 1.5, -2.0, -7)]
    assert machine.read(FIRST, 1) == b"\x08"


def test_segments_have_addresses_of_their_own():
    globals_ = ir.Segment("global")
    there = ir.Place(globals_, 4, 9)
    tested = module(unit(ir.Store(1, "w32", there, load(0))), segments=(PROGRAM, globals_))
    code = generate(tested)
    assert code.segments == (PROGRAM, globals_)
    assert code.place({"program": FIRST, "global": FIRST + 64}) != code.place(
        {"program": FIRST, "global": FIRST + 128}
    )


def test_a_function_with_a_result_may_go_on_for_ever(compiled):
    machine = compiled(
        module(function("F", ("i32",), "i32", ir.Loop(1, 1, [ir.Return(1, number(3))])))
    )
    assert machine.run("F", 0) == 3


def test_the_same_module_gives_the_same_bytes():
    def made():
        body = [
            evaluate(call("rt.string_assign", address(0), address(40), number(9))) for _ in "ab"
        ]
        return generate(
            module(
                unit(
                    *body,
                    store(100, call("rt.string_compare", address(0), address(40), result="i32")),
                )
            )
        )

    assert made().wasm == made().wasm


def test_a_module_without_functions():
    assert compile_wasm(generate(module()).wasm) is not None


def test_an_unknown_function_is_an_error_of_the_front_end():
    with pytest.raises(KeyError):
        generate(module(unit(evaluate(call("nothing")))))


def test_helpers_are_there_once_and_only_where_they_are_called():
    names = [f.name for f in generate(program(store(0, 1))).lines.functions]
    assert names == ["CYCLIC"]
    compared = call("rt.string_compare", address(0), address(40), result="i32")
    code = generate(module(unit(store(0, compared), store(4, compared))))
    assert [(f.name, f.kind) for f in code.lines.functions] == [
        ("CYCLIC", "unit"),
        ("rt.string_compare", "helper"),
    ]
