"""Libraries with bodies in C, called from programs in every language, and what they share."""

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State

UTIL = {
    "util/ANSIC.lby": "<Library/>",
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
    """,
    "util/util.var": "VAR uCalls : UDINT; END_VAR\nVAR CONSTANT FACTOR : REAL := 1.5; END_VAR\n",
    "util/scaler.c": """
        #include <bur/plctypes.h>
        #include "util.h"
        static UDINT all = 100;
        void Scaler(struct Scaler *inst)
        {
            inst->y = inst->x * FACTOR;
            inst->calls = inst->calls + 1;
            all++;
        }
        signed long Sum(signed short a, unsigned char b, plcbit negative)
        {
            uCalls = all;
            return negative ? -(a + b) : a + b;
        }
    """,
    "util/functions.c": """
        #include "Util.h"
        plcbit IsLong(ULINT n) { return n > 0xFFFFFFFFULL; }
    """,
}
ST = """
    PROGRAM _CYCLIC
        s(x := 2.0);
        sum := Sum(-3, 200, TRUE);
        long := IsLong(16#1_0000_0000);
    END_PROGRAM
"""
C = """
    #include <AsDefault.h>
    void _CYCLIC run(void)
    {
        s.x = 2;
        Scaler(&s);
        sum = Sum(-3, 200, 1);
        long_ = IsLong(0x100000000);
    }
"""
DECLARED = "VAR s : Scaler; sum : DINT; long : BOOL; END_VAR\n"
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
"""
MAINS = {
    "Structured Text": {"main/Cyclic.st": ST, "main/Variables.var": DECLARED},
    "Python": {"main/main.py": PYTHON, "main/Variables.var": DECLARED},
    "C": {"main/Main.c": C, "main/Variables.var": DECLARED},
}


@pytest.fixture(autouse=True)
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


@pytest.mark.parametrize("language", MAINS)
def test_programs_call_blocks_and_functions_in_c(run, value, language):
    controller = run(UTIL | MAINS[language])
    assert controller.state is State.RUN, controller.fault
    names = ("main.s.y", "main.s.calls", "main.sum", "main.long", "uCalls")
    assert [value(controller, name) for name in names] == [3.0, 3, -197, True, 103]


def test_a_library_begins_with_its_initial_values_at_each_boot(run, value):
    files = {"main/Main.c": C.replace("s.x = 2;", "if (uCalls == 102) *(int *)0 = 1;")}
    controller = run(UTIL | MAINS["C"] | files)
    assert (controller.state, value(controller, "uCalls")) == (State.SERVICE, 102)
    controller.boot()
    controller.run(cycles=1)
    assert value(controller, "uCalls") == 101


def test_a_fault_in_c_called_from_structured_text_has_both_lines(run):
    files = dict(UTIL)
    files["util/scaler.c"] = files["util/scaler.c"].replace("all++;", "*(int *)0 = 1;")
    controller = run(files | MAINS["Structured Text"])
    assert controller.state is State.SERVICE
    outer, inner = controller.fault.calls
    assert outer.endswith("main/Cyclic.st:3 in cyclic")
    assert inner.endswith("util/scaler.c:9 in Scaler")
    assert controller.fault.reason == "page fault: address 16#00000000"


def test_c_calls_blocks_and_functions_in_structured_text_and_python(run, value, ramp):
    files = ramp | {
        "text/text.fun": "FUNCTION Half : INT VAR_INPUT x : INT; END_VAR END_FUNCTION\n",
        "text/half.st": "FUNCTION Half Half := x / 2; END_FUNCTION\n",
        "main/Main.c": """
            #include <AsDefault.h>
            void _CYCLIC run(void)
            {
                r.Enable = 1;
                Ramp(&r);
                y = twice(r.Out) + STEP;
                z = Half(-10);
            }
        """,
        "main/V.var": "VAR r : Ramp; y : UDINT; z : INT; END_VAR",
    }
    controller = run(files)
    assert [value(controller, n) for n in ("main.r.Out", "main.y", "main.z")] == [9, 21, -5]


def test_global_variables_are_shared_with_other_languages(run, value):
    plc = '[task_class.1]\ncycle = "10ms"\nprograms = ["main", "text"]\n'
    files = {
        "plc.toml": plc,
        "Global.var": "VAR count : UDINT := 5; END_VAR VAR CONSTANT TOP : UDINT := 90; END_VAR",
        "Global.typ": "TYPE Mode : (OFF, ON := 7); END_TYPE",
        "main/Main.c": "#include <AsDefault.h>\nvoid _CYCLIC f(void) { count += TOP + ON; }\n",
        "text/Main.st": "PROGRAM _CYCLIC count := count + 1; END_PROGRAM",
    }
    assert value(run(files), "count") == 5 + 3 * (90 + 7 + 1)


def test_what_a_function_in_c_cannot_give_is_told(run):
    files = {
        "util/util.fun": "FUNCTION Title : STRING[10] VAR_INPUT n : INT; END_VAR END_FUNCTION",
        "util/util.c": "char *Title(short n) { return 0; }",
        "main/Main.c": C,
        "main/Variables.var": "",
    }
    with pytest.raises(ConfigurationError, match=r"util\.fun:1:1.*Title gives STRING\[10\]"):
        run(files)


def test_errors_in_a_library_are_told_once_with_their_places(run):
    files = UTIL | {"util/functions.c": "int f(void) { return x; }"} | MAINS["C"]
    with pytest.raises(ConfigurationError) as caught:
        run(files)
    (finding,) = caught.value.findings
    assert "util/functions.c:1:22: use of undeclared identifier 'x'" in finding
