import marshal
import random

import pytest

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen import storage
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.codegen.options import CodegenOptions
from plcsim.program.structured_text.codegen.storage import compiler, dump, load

from .build import module, unit
from .random_ir import Maker


@pytest.mark.parametrize("counters", [False, True])
def test_what_was_dumped_comes_out_again(counters):
    code = generate(Maker(random.Random(5)).module(), CodegenOptions(counters=counters))
    found = load(dump(code))
    assert (found.name, found.wasm) == (code.name, code.wasm)
    assert found.holes == code.holes
    assert found.lines.functions == code.lines.functions
    assert found.lines.traps == code.lines.traps
    assert [(one.space, one.name) for one in found.imports] == [
        ("block", "FOREIGN"),
        ("function", "foreign"),
    ]
    assert found.imports[1].signature.result == "i32"
    assert tuple(found.imports[1].signature.parameters) == ("i32", "f64")
    if counters:
        assert vars(found.profile) == vars(code.profile) | {"files": list(code.profile.files)}
    else:
        assert found.profile is None


def test_segments_keep_their_data():
    hidden = ir.Segment("hidden", 4, 2, b"ABC\0")
    found = load(dump(generate(module(unit(), segments=(ir.Segment("program"), hidden)))))
    rows = [(s.name, s.size, s.alignment, s.data) for s in found.segments]
    assert rows == [("program", 0, 4, None), ("hidden", 4, 2, b"ABC\0")]
    assert found.place({"program": 0x11_0000, "hidden": 0x12_0000})


def test_other_bytes_are_no_module():
    data = dump(generate(module(unit())))
    for other in (
        b"",
        b"abc",
        data[:-5],
        marshal.dumps((1, 2)),
        marshal.dumps(7),
        data[: len(data) // 2],
    ):
        assert load(other) is None


def test_a_changed_compiler_is_told_from_the_old_one(tmp_path, monkeypatch):
    file = tmp_path / "compiler.py"
    file.write_text("a")
    monkeypatch.setattr(storage, "_OF_THE_COMPILER", (tmp_path,))
    compiler.cache_clear()
    first = compiler()
    compiler.cache_clear()
    assert compiler() == first
    file.write_text("ab")
    compiler.cache_clear()
    assert compiler() != first
    monkeypatch.undo()
    compiler.cache_clear()
    assert len(compiler()) == 16
