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
        "util/util.fun": "FUNCTION Pair : ARRAY[0..1] OF INT VAR_INPUT n:INT; END_VAR END_FUNCTION",
        "util/util.c": "short *Pair(short n) { return 0; }",
        "main/Main.c": C,
        "main/Variables.var": "",
    }
    with pytest.raises(ConfigurationError, match=r"util\.fun:1:1.*Pair gives ARRAY"):
        run(files)


TITLES = {
    "titles/ANSIC.lby": "<Library/>",
    "titles/titles.fun": """
        FUNCTION Title : STRING[4]
            VAR_INPUT n : INT; upper : BOOL; END_VAR
        END_FUNCTION
        FUNCTION Wide : WSTRING[4]
            VAR_INPUT n : INT; END_VAR
        END_FUNCTION
        FUNCTION Behind : STRING[0]
            VAR_INPUT text : STRING[0]; n : UDINT; END_VAR
        END_FUNCTION
        FUNCTION Count : INT
        END_FUNCTION
    """,
    "titles/titles.c": """
        #include "titles.h"
        static int calls;
        plcstring *Title(signed short n, plcbit upper)
        {
            static char long_[] = "abcdef";
            calls++;
            return n == 0 ? 0 : n == 1 ? long_ : upper ? "UP" : "down";
        }
        plcwstring *Wide(signed short n)
        {
            static plcwstring wide[] = {'v', 'w', 0x20AC, 'x', 'y', 'z', 0};
            return wide + n;
        }
        plcstring *Behind(plcstring *text, unsigned long n) { return n > 9 ? 0 : text + n; }
        signed short Count(void) { return calls + (Title(1, 0)[5] == 'f'); }
    """,
}
TITLES_DECLARED = """
    VAR
        a, b, c : STRING[80]; wide, end : WSTRING[80]; count : INT; at : DINT; is_nil : BOOL;
    END_VAR
"""
TITLES_FROM = {
    "Structured Text": {
        "main/Cyclic.st": """
            PROGRAM _CYCLIC
                a := Title(1, FALSE); b := Title(2, TRUE); c := Title(2, FALSE);
                wide := Wide(0); end := Wide(4);
                count := Count();
            END_PROGRAM
        """,
    },
    "Python": {
        "main/main.py": PYTHON.partition("class Main")[0]
        + """
    class Main(Program):
        def cyclic(self):
            self.a = call(self.context, "Title", 1, False)
            self.b = call(self.context, "Title", 2, True)
            self.c = call(self.context, "Title", 2, False)
            self.wide = call(self.context, "Wide", 0)
            self.end = call(self.context, "Wide", 4)
            self.count = call(self.context, "Count")
""",
    },
}


@pytest.mark.parametrize("language", TITLES_FROM)
def test_a_string_of_a_function_in_c_is_copied_and_cut_off(run, value, language):
    files = TITLES | TITLES_FROM[language] | {"main/V.var": TITLES_DECLARED}
    controller = run(files, cycles=1)
    assert controller.state is State.RUN, controller.fault
    names = ("a", "b", "c", "wide", "end", "count")
    found = [value(controller, f"main.{name}") for name in names]
    assert found == ["abcd", "UP", "down", "vw\u20acx", "yz", 4]


def test_c_gets_the_address_that_a_function_in_c_returns(run, value):
    files = TITLES | {
        "main/Main.c": """
            #include <string.h>
            #include <AsDefault.h>
            void _CYCLIC f(void)
            {
                strcpy(a, Title(1, 0));
                at = Behind(a, 2) - a;
                is_nil = !Behind(a, 10);
            }
        """,
        "main/V.var": TITLES_DECLARED,
    }
    controller = run(files)
    assert controller.state is State.RUN, controller.fault
    assert [value(controller, f"main.{n}") for n in ("a", "at", "is_nil")] == ["abcdef", 2, True]


def test_only_a_call_of_what_has_no_length_is_refused(run):
    files = TITLES | {
        "main/Cyclic.st": "PROGRAM _CYCLIC (* Behind() *)\n a := Behind('b', 1);\nEND_PROGRAM",
        "main/V.var": TITLES_DECLARED,
    }
    told = (
        r"main/Cyclic\.st:2:7: error: Behind gives STRING\[0\] \(.*titles\.fun:8:\d+\), "
        r"an address without a length: only C can call it"
    )
    with pytest.raises(ConfigurationError, match=told):
        run(files)
    files["main/Cyclic.st"] = "PROGRAM _CYCLIC count := Count(); END_PROGRAM"
    assert run(files).state is State.RUN


def test_python_is_refused_what_has_no_length_where_it_calls(run):
    main = (
        PYTHON.partition("class Main")[0]
        + """
    class Main(Program):
        def cyclic(self):
            call(self.context, "Behind", 0, 1)
"""
    )
    controller = run(TITLES | {"main/main.py": main, "main/V.var": TITLES_DECLARED})
    assert controller.state is State.SERVICE
    assert "Behind gives STRING[0]" in controller.fault.reason
    assert controller.fault.location.endswith("main/main.py:6")


def test_an_address_of_nothing_is_a_page_fault_where_it_is_called(run):
    files = TITLES | {
        "main/Cyclic.st": "PROGRAM _CYCLIC\n a := Title(0, FALSE);\nEND_PROGRAM",
        "main/V.var": TITLES_DECLARED,
    }
    controller = run(files)
    assert controller.state is State.SERVICE
    assert "page fault" in controller.fault.reason
    assert controller.fault.calls[0].endswith("main/Cyclic.st:2 in cyclic")


def test_libraries_in_c_that_need_each_other_give_strings(run, value):
    files = {
        "one/ANSIC.lby": "<Library/>",
        "one/one.fun": """
            FUNCTION Text : STRING[0] VAR_INPUT n : INT; END_VAR END_FUNCTION
            FUNCTION Outer : INT END_FUNCTION
        """,
        "one/one.c": """
            #include <AsDefault.h>
            plcstring *Text(signed short n) { return n == 1 ? "a" : "z"; }
            signed short Outer(void) { return Inner(); }
        """,
        "two/ANSIC.lby": "<Library/>",
        "two/two.fun": "FUNCTION Inner : INT END_FUNCTION",
        "two/two.c": """
            #include <AsDefault.h>
            signed short Inner(void) { return Text(1)[0] + Text(2)[0]; }
        """,
        "main/Main.st": "PROGRAM _CYCLIC count := Outer(); END_PROGRAM",
        "main/V.var": TITLES_DECLARED,
    }
    controller = run(files)
    assert controller.state is State.RUN, controller.fault
    assert value(controller, "main.count") == ord("a") + ord("z")


def test_c_gets_the_address_of_a_string_from_structured_text_and_python(run, value):
    files = {
        "text/text.fun": "FUNCTION Name : STRING[5] VAR_INPUT x : BOOL; END_VAR END_FUNCTION\n",
        "text/name.st": "FUNCTION Name Name := SEL(x, 'no', 'yes'); END_FUNCTION",
        "snake/snake.fun": "FUNCTION Kind : STRING[5] VAR_INPUT x : BOOL; END_VAR END_FUNCTION\n",
        "snake/kind.py": """
            from plcsim.library.executable import function

            @function("Kind")
            def kind(context, x):
                return f"is {x}"
        """,
        "main/Main.c": """
            #include <string.h>
            #include <AsDefault.h>
            void _CYCLIC f(void)
            {
                strcpy(a, Name(1));
                strcpy(b, Name(0));
                strcpy(c, Kind(1));
            }
        """,
        "main/V.var": TITLES_DECLARED,
    }
    controller = run(files)
    assert controller.state is State.RUN, controller.fault
    assert [value(controller, f"main.{n}") for n in "abc"] == ["yes", "no", "is Tr"]


def test_errors_in_a_library_are_told_once_with_their_places(run):
    files = UTIL | {"util/functions.c": "int f(void) { return x; }"} | MAINS["C"]
    with pytest.raises(ConfigurationError) as caught:
        run(files)
    (finding,) = caught.value.findings
    assert "util/functions.c:1:22: use of undeclared identifier 'x'" in finding


def test_c_reads_the_constants_of_libraries_that_are_arrays(run, value):
    """A library, another one and a program: each by the header of the one that declares them."""
    files = {
        "signs/signs.fun": "FUNCTION Own : INT END_FUNCTION",
        "signs/signs.var": """
            VAR CONSTANT
                sQUOTE : ARRAY[0..1] OF USINT := [34, 0];
                aLEVELS : ARRAY[1..3] OF INT := [-7, 2(500)];
            END_VAR
        """,
        "signs/signs.c": '#include "signs.h"\nshort Own(void) { return sQUOTE[0]; }',
        "user/ANSIC.lby": '<L><Dependencies><Dependency ObjectName="signs"/></Dependencies></L>',
        "user/user.fun": "FUNCTION Other : INT END_FUNCTION",
        "user/user.c": """
            #include <string.h>
            #include "user.h"
            short Other(void) { return strlen((char *)&sQUOTE) + aLEVELS[0]; }
        """,
        "main/V.var": "VAR own, other, here : INT; END_VAR",
        "main/Main.c": """
            #include <AsDefault.h>
            void _CYCLIC run(void) { own = Own(); other = Other(); here = aLEVELS[2]; }
        """,
    }
    controller = run(files)
    assert [value(controller, f"main.{name}") for name in ("own", "other", "here")] == [34, -6, 500]
