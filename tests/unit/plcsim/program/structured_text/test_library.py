"""Libraries with bodies in Structured Text, called from programs and other libraries."""

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State

UTIL = {
    "util/util.fun": """
        FUNCTION_BLOCK Scaler
            VAR_INPUT x : REAL; END_VAR
            VAR_OUTPUT y : REAL; END_VAR
            VAR calls : UDINT; END_VAR
        END_FUNCTION_BLOCK
        FUNCTION Sum : DINT
            VAR_INPUT a : INT; b : USINT; negative : BOOL; END_VAR
        END_FUNCTION
        FUNCTION IsLong : BOOL
            VAR_INPUT n : ULINT; END_VAR
        END_FUNCTION
        FUNCTION Title : STRING[10]
            VAR_INPUT n : INT; END_VAR
        END_FUNCTION
    """,
    "util/util.var": "VAR uCalls : UDINT; END_VAR\nVAR CONSTANT FACTOR : REAL := 1.5; END_VAR\n",
    "util/Scaler.st": """
        FUNCTION_BLOCK Scaler
            y := x * FACTOR;
            calls := calls + 1;
        END_FUNCTION_BLOCK
    """,
    "util/functions.st": """
        FUNCTION Sum
            Sum := a + b;
            IF negative THEN Sum := -Sum; END_IF
            uCalls := uCalls + 1;
        END_FUNCTION
        FUNCTION IsLong
            IsLong := n > 16#FFFF_FFFF;
        END_FUNCTION
        FUNCTION Title
            CASE n OF 0: Title := 'none'; ELSE Title := 'some'; END_CASE
        END_FUNCTION
    """,
}
MAIN = """
    PROGRAM _CYCLIC
        s(x := 2.0);
        sum := Sum(-3, 200, TRUE);
        long := IsLong(16#1_0000_0000);
        title := Title(1);
    END_PROGRAM
"""
DECLARED = "VAR s : Scaler; sum : DINT; long : BOOL; title : STRING[20]; END_VAR\n"
PYTHON = """
    from plcsim import Program
    from plcsim.program.site import Site

    def call(context, name, *given):
        return Site.of(context).catalogue.find_function(name)[1].bind(context)(*given)

    class Main(Program):
        def cyclic(self):
            self.s(x=2.0)
            self.sum = call(self.context, "Sum", -3, 200, True)
            self.long = call(self.context, "IsLong", 1 << 32)
            self.title = call(self.context, "Title", 1)
"""


def figures(controller, value):
    names = ("main.s.y", "main.s.calls", "main.sum", "main.long", "main.title", "uCalls")
    return [value(controller, name) for name in names]


def test_programs_in_structured_text_call_them(run, value):
    files = {"main/Cyclic.st": MAIN, "main/Variables.var": DECLARED}
    controller = run(UTIL | files)
    assert figures(controller, value) == [3.0, 3, -197, True, "some", 3]


def test_bodies_and_programs_in_other_languages(run, value):
    """A block in Ladder counts rising edges by a function in Instruction List."""
    ladder = (
        "{0} {1}\n<?xml version='1.0'?>\n<networks><network>{2}</network></networks>\nEND_{0}\n"
    )
    body = """
        <row><contact type="positive transition" name="pulse"/>
          <function position="top" type="Next"><input name="EN"/><output name="ENO"/></function>
          <coil type="open" name="seen"/></row>
        <row><analog name="count"/>
          <function position="bottom"><input name="n"/><output name=""/></function>
          <analog name="count"/></row>
    """
    call = """
        <row><empty/><functionblock position="header" name="edges"/></row>
        <row><contact type="open" name="on"/>
          <functionblock position="top" type="Edges"><input name="pulse"/></functionblock></row>
    """
    files = {
        "util/util.fun": """
            FUNCTION_BLOCK Edges
                VAR_INPUT pulse : BOOL; END_VAR
                VAR_OUTPUT count : DINT; seen : BOOL; END_VAR
                VAR zzEdge00000 : BOOL; END_VAR
            END_FUNCTION_BLOCK
            FUNCTION Next : DINT
                VAR_INPUT n : DINT; END_VAR
            END_FUNCTION
        """,
        "util/Edges.ld": ladder.format("FUNCTION_BLOCK", "Edges", body),
        "util/Next.il": "FUNCTION Next\nLD n\nADD 1\nST Next\nEND_FUNCTION\n",
        "main/Init.st": "PROGRAM _INIT\non := FALSE;\nEND_PROGRAM\n",
        "main/Cyclic.ld": ladder.format("PROGRAM", "_CYCLIC", call),
        "main/Blink.il": "ACTION Blink:\nLDN on\nST on\nEND_ACTION\n",
        "main/Exit.st": "PROGRAM _EXIT\nBlink;\nEND_PROGRAM\n",
        "main/Main.var": "VAR on : BOOL; edges : Edges; END_VAR\n",
    }
    controller = run(files)
    assert value(controller, "main.edges.count") == 0
    controller = run(files | {"main/Init.st": "PROGRAM _INIT\non := TRUE;\nEND_PROGRAM\n"})
    assert value(controller, "main.edges.count") == 1
    assert value(controller, "main.edges.seen") is False


def test_programs_in_python_call_them(run, value):
    files = {"main/main.py": PYTHON, "main/Variables.var": DECLARED}
    controller = run(UTIL | files)
    assert controller.fault is None
    assert figures(controller, value) == [3.0, 3, -197, True, "some", 3]


@pytest.mark.parametrize("body", ["st", "python"])
def test_libraries_call_each_other(run, value, body):
    bodies = {
        "st": {"b/b.st": "FUNCTION B\nIF n > 0 THEN B := A(n - 1) + 1; END_IF\nEND_FUNCTION\n"},
        "python": {
            "b/b.py": """
                from plcsim.library.executable import function
                from plcsim.program.site import Site

                @function("B")
                def b(context, n):
                    a = Site.of(context).catalogue.find_function("A")[1].bind(context)
                    return a(n - 1) + 1 if n > 0 else 0
            """
        },
    }
    one = "FUNCTION {} : DINT VAR_INPUT n : DINT; END_VAR END_FUNCTION\n"
    files = {
        "a/a.fun": one.format("A"),
        "a/a.st": "FUNCTION A\nIF n > 0 THEN A := B(n - 1) + 10; END_IF\nEND_FUNCTION\n",
        "b/b.fun": one.format("B"),
        "main/Cyclic.st": "PROGRAM _CYCLIC\nx := A(5);\nEND_PROGRAM\n",
        "main/Variables.var": "VAR x : DINT; END_VAR\n",
    }
    controller = run(files | bodies[body])
    assert controller.fault is None
    assert value(controller, "main.x") == 32


def test_a_fault_tells_the_line_in_the_library(run):
    files = {
        "lib/lib.fun": "FUNCTION f : DINT VAR_INPUT n : DINT; END_VAR END_FUNCTION\n",
        "lib/f.st": "FUNCTION f\n\nf := 1 / n;\nEND_FUNCTION\n",
        "main/Cyclic.st": "PROGRAM _CYCLIC\nx := f(0);\nEND_PROGRAM\n",
        "main/Variables.var": "VAR x : DINT; END_VAR\n",
    }
    controller = run(files)
    assert controller.state is State.SERVICE
    assert controller.fault.location.endswith("lib/f.st:3")
    assert controller.fault.calls[0].endswith("main/Cyclic.st:2 in cyclic")


def test_errors_in_a_library_are_told(run):
    files = UTIL | {"util/Scaler.st": "FUNCTION_BLOCK Scaler\nz := 1;\nEND_FUNCTION_BLOCK\n"}
    with pytest.raises(ConfigurationError, match=r"Scaler\.st:2:1: error ST2001: no variable"):
        run(files | {"main/Cyclic.st": MAIN, "main/Variables.var": DECLARED})
    files = UTIL | {"util/Scaler.st": "FUNCTION_BLOCK Scaler\nz := ;\nEND_FUNCTION_BLOCK\n"}
    with pytest.raises(ConfigurationError, match=r"Scaler\.st:2:6: error ST1001"):
        run(files | {"main/Cyclic.st": MAIN, "main/Variables.var": DECLARED})


def test_a_block_in_a_library_has_its_edges_in_its_data(run, value):
    files = {
        "lib/lib.fun": """
            FUNCTION_BLOCK Edge
                VAR_INPUT in : BOOL; END_VAR
                VAR n : INT; zzEdge00000 : BOOL; END_VAR
            END_FUNCTION_BLOCK
        """,
        "lib/Edge.st": """
            FUNCTION_BLOCK Edge
                IF EDGEPOS(in) THEN n := n + 1; END_IF
            END_FUNCTION_BLOCK
        """,
        "main/Cyclic.st": "PROGRAM _CYCLIC\ne(in := TRUE);\nEND_PROGRAM\n",
        "main/Variables.var": "VAR e : Edge; END_VAR\n",
    }
    controller = run(files)
    assert value(controller, "main.e.n") == 1
    controller.shutdown()
    controller.boot()
    controller.run(cycles=2)
    assert value(controller, "main.e.n") == 1
