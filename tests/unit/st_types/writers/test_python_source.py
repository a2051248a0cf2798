import itertools
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import given
from hypothesis import strategies as st

import st_types
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_text
from st_types.types.derived import Section, StructType, resolve_alias
from st_types.types.values import initial_image
from st_types.types.views import type_of
from st_types.writers.python_source import PythonModule, python_source

from ..checked import checked

DECLARATIONS = """
VAR CONSTANT MAX : UINT := 2; NAME : STRING[9] := 'a$$'; RATE : REAL := 0.5; LIST : ARRAY[0..1] OF
    INT := [1, 2]; END_VAR
TYPE
    Cell : STRUCT p : Point := (x := 1.5); n : ARRAY[0..MAX, 1..3] OF Point; class : BOOL := TRUE;
        Point : Point; second : Point; var : Mode := on; t : TIME := T#1s; END_STRUCT;
    Point : STRUCT x : LREAL; m : Mode; b : ARRAY[-1..3] OF BOOL := [5(TRUE)]; END_STRUCT;
    Mode : (off, on := 5);
    Odd : (mro, _x, None);
    Text : STRING[8] := 'text';
    Copy : Point := (m := on);
    Low : USINT(2..9);
    Lowest : Low := 3;
    Node : STRUCT next : REFERENCE TO Node; o : Odd; low : Low; other : Lowest; END_STRUCT;
    Empty : STRUCT END_STRUCT;
END_TYPE
FUNCTION_BLOCK Block
    VAR_INPUT e : BOOL := TRUE; i : INT; END_VAR
    VAR_OUTPUT q : WSTRING[3]; END_VAR
    VAR s : Cell; END_VAR
END_FUNCTION_BLOCK
VAR Block : Block; text, Copy : Text; copies : ARRAY[0..9] OF Copy; END_VAR
"""

_numbers = itertools.count()


def module_of(text: str) -> ModuleType:
    module = ModuleType(f"generated_{next(_numbers)}")
    exec(compile(text, module.__name__, "exec"), module.__dict__)
    return module


def table_of(text: str) -> Scope:
    return checked([parse_text(text)], strict=True)


def check(table: Scope) -> ModuleType:
    """Import the module and compare each class with the type it was made from."""
    module = module_of(python_source(PythonModule("test", table), "Test"))
    for declared in table.data_types():
        data_type = resolve_alias(declared)
        if isinstance(data_type, StructType):
            made = type_of(getattr(module, declared.name))
            assert made.size == data_type.size
            assert made.offsets == data_type.offsets
            assert [str(m.name) for m in made.members] == [m.name for m in data_type.members]
            assert initial_image(made) == initial_image(declared)
    return module


def test_views_lie_as_declared_and_start_with_the_declared_values() -> None:
    module = check(table_of(DECLARATIONS))
    variables = module.Variables()
    assert variables.Block.s.Point.m is module.Mode.off
    assert variables.Block.s.t == 1000
    assert variables.text == "text"
    assert variables.copies[9].m is module.Mode.on
    assert getattr(variables.Block.s, "class") is True
    assert (module.MAX, module.NAME, module.RATE) == (2, "a$", 0.5)
    assert module.LIST == [1, 2]


def test_a_member_does_not_hide_what_members_below_it_need() -> None:
    module = check(
        table_of(
            "TYPE INT_ : INT; S : STRUCT INT : INT_; OF : REFERENCE TO REAL; "
            "a : ARRAY[0..1] OF INT; r : REFERENCE TO ARRAY[0..1] OF INT; var : BOOL; b : INT; "
            "END_STRUCT; END_TYPE"
        )
    )
    assert module.S().a[1] == module.S().b == 0


def test_a_union_and_a_struct_that_extends_another_one() -> None:
    module = check(
        table_of(
            "TYPE U : UNION r : REAL := 1.0; d : UDINT; END_UNION; Base : STRUCT x : INT := 3; "
            "END_STRUCT; More EXTENDS Base : STRUCT u : U; END_STRUCT; END_TYPE"
        )
    )
    assert (module.More().x, module.More().u.d) == (3, 0x3F800000)


def test_names_that_python_cannot_have() -> None:
    module = check(table_of("TYPE class : INT; END_TYPE"))
    assert module.class_.name == "class"


@pytest.mark.parametrize("name", ["DataBlock", "IntEnum", "ReferenceType", "Final", "var_input"])
def test_names_that_the_module_needs_itself(name: str) -> None:
    table = table_of(
        f"TYPE {name} : STRUCT x : INT := 7; END_STRUCT; Mode : (off, on); END_TYPE "
        "VAR CONSTANT K : INT := 1; END_VAR FUNCTION_BLOCK F VAR_INPUT i : INT; END_VAR "
        f"VAR r : REFERENCE TO INT; s : {name}; END_VAR END_FUNCTION_BLOCK"
    )
    module = module_of(python_source(PythonModule("test", table), "Test"))
    assert getattr(module, f"{name}_")().x == module.F().s.x == 7


def test_a_var_in_out_is_an_address() -> None:
    module = check(
        table_of(
            "FUNCTION_BLOCK F VAR n : UINT; END_VAR VAR_IN_OUT io : INT; b : BOOL; END_VAR "
            "VAR_INPUT e : BOOL; END_VAR END_FUNCTION_BLOCK"
        )
    )
    assert {m.name: m.section for m in type_of(module.F).members} == {
        "n": Section.INTERNAL,
        "io": Section.IN_OUT,
        "b": Section.IN_OUT,
        "e": Section.INPUT,
    }
    assert bytes(module.F(io=4096, b=4098, n=3, e=True)).hex() == "001000000210000003000100"


def test_the_docstring_is_one_line() -> None:
    text = python_source(PythonModule("test", table_of("")), 'Types of "a"\n\\b.')
    assert text == '"""Types of \'a\' \\\\b."""\n\nfrom __future__ import annotations\n'
    assert module_of(text).__doc__ == "Types of 'a' \\b."


def test_mypy_knows_the_members(tmp_path: Path) -> None:
    (tmp_path / "cell_types.py").write_text(
        python_source(PythonModule("test", table_of(DECLARATIONS)), "Test")
    )
    (tmp_path / "use.py").write_text(
        "from cell_types import Cell, Mode, Variables\n"
        "def read(v: Variables) -> float:\n"
        "    mode: Mode = v.Block.s.p.m\n"
        "    name: str = v.text\n"
        "    return v.copies[0].x + v.Block.s.t + len(name) + mode\n"
        "def wrong(cell: Cell) -> str:\n"
        "    return cell.t\n"
        "def missing(cell: Cell) -> object:\n"
        "    return cell.nothing\n"
    )
    root = Path(st_types.__file__).parents[1]
    command = [sys.executable, "-m", "mypy", "--strict", "--explicit-package-bases"]
    command += ["--config-file=", "--cache-dir", str(tmp_path / "cache"), "use.py", "cell_types.py"]
    done = subprocess.run(
        command,
        cwd=tmp_path,
        env={"MYPYPATH": str(root)},
        capture_output=True,
        text=True,
        check=False,
    )
    lines = [line for line in done.stdout.splitlines() if "error" in line]
    assert lines[0].startswith("use.py:7: error: Incompatible return value type"), done.stdout
    assert lines[1].startswith('use.py:9: error: "Cell" has no attribute "nothing"'), done.stdout
    assert lines[2] == "Found 2 errors in 1 file (checked 2 source files)"


def test_constants_of_every_kind() -> None:
    module = module_of(
        python_source(
            PythonModule(
                "test",
                table_of(
                    "VAR CONSTANT a : INT; p : Point := (x := 2); l : ARRAY[0..2] OF Point; "
                    "m : Mode := on; END_VAR TYPE Point : STRUCT x : INT; y : INT := 3; "
                    "END_STRUCT; Mode : (off, on := 4); END_TYPE"
                ),
            ),
            "Test",
        )
    )
    assert (module.a, module.p, module.m) == (0, {"x": 2}, 4)
    assert module.l == [{"x": 0, "y": 3}] * 3


def test_what_other_modules_declare_is_imported() -> None:
    outer = table_of("TYPE S : STRUCT x : INT; END_STRUCT; Mode : (off, on); END_TYPE")
    inner = checked(
        [parse_text("TYPE S : BOOL; END_TYPE VAR m : Mode; s : S; END_VAR")], [outer], strict=True
    )
    project = PythonModule("project", outer)
    python_source(project, "Project")
    text = python_source(PythonModule("program", inner, [project]), "Program")
    assert "\nfrom .project import Mode_TYPE\n" in text
    assert "    m = var(Mode_TYPE)\n    s = var(S)\n" in text
    second = checked([parse_text("TYPE T : INT; END_TYPE VAR T : T; s : U; END_VAR")])
    assert 'T = AliasType("T", INT)'.replace('"', "'") in python_source(
        PythonModule("x", second), "X"
    )


def test_a_block_that_is_executed_is_imported_and_others_say_that_they_are_not() -> None:
    scope = table_of(
        "FUNCTION_BLOCK A VAR x : INT; END_VAR END_FUNCTION_BLOCK FUNCTION_BLOCK B VAR a : A; "
        "END_VAR END_FUNCTION_BLOCK FUNCTION F : INT END_FUNCTION"
    )
    block = scope.find_type("A")
    assert block is not None
    text = python_source(PythonModule("test", scope, (), {block: ("some.library", "A")}), "Test")
    assert "\nfrom some.library import A as A\n" in text
    assert "Data block of B; nothing executes it here: it cannot be called." in text
    assert "    a = var(A)\n" in text
    assert "class A" not in text
    assert "\n# Functions, which Python cannot call: F.\n" in text


NAMES = ["A", "B", "var", "INT", "from", "x", "Struct"]
members = st.dictionaries(
    st.sampled_from(NAMES),
    st.sampled_from(["INT", "B", "STRING[4] := 'x'", "ARRAY[0..1] OF B", "Mode := on", "(p, q)"]),
    max_size=5,
)


@pytest.mark.parametrize("kind", ["STRUCT", "FUNCTION_BLOCK"])
@given(lists=st.lists(members, min_size=1, max_size=3))
def test_random_declarations(kind: str, lists: list[dict[str, str]]) -> None:
    text = "TYPE B : STRUCT b : BOOL := TRUE; END_STRUCT; Mode : (off, on); END_TYPE "
    for number, found in enumerate(lists):
        body = " ".join(f"{name} : {declared};" for name, declared in found.items())
        if kind == "STRUCT":
            text += f"TYPE T{number} : STRUCT {body} END_STRUCT; END_TYPE "
        else:
            text += f"FUNCTION_BLOCK T{number} VAR {body} END_VAR END_FUNCTION_BLOCK "
    check(table_of(text))
