"""Global variables and constants in Python programs."""

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.program.python.shared import ConstantAttribute
from st_types import UDINT, Struct, var
from st_types.types.derived import StructType

GLOBAL = """
    VAR
        gCount : UDINT := 5;
        gAxis : Axis;
        hidden : UINT := 3;
    END_VAR
    VAR CONSTANT
        LIMIT : UDINT := 9;
        TABLE_ : ARRAY[1..3] OF INT := [1, 2, 3];
    END_VAR
"""
TYPES = "TYPE Axis : STRUCT speed : REAL; END_STRUCT; END_TYPE"


MAIN = """\
from plcsim import Program, var_external
from st_types import UDINT, UINT

class Main(Program):
    {head}

    def cyclic(self):
        {line}
"""


def files(line, head="", variables="", more=None):
    """Return a project whose program does this in its cycles."""
    main = MAIN.format(head=head or "pass", line=line)
    found = {"Global.var": GLOBAL, "Global.typ": TYPES, "main/main.py": main}
    return found | {"main/Variables.var": variables} | (more or {})


def test_global_variables_are_read_and_written_by_name(run, value):
    controller = run(files("self.gCount += 1; self.gAxis.speed = 2.5"))
    assert controller.state is State.RUN
    assert value(controller, "gCount") == value(controller, "::gCount") == 8
    assert value(controller, "gAxis") == {"speed": 2.5}


def test_a_restart_gives_them_their_initial_values_again(run, value):
    controller = run(files("self.gCount += 1"))
    controller.shutdown()
    controller.boot()
    assert value(controller, "gCount") == 5


def test_a_local_variable_hides_a_global_one(run, value):
    variables = "VAR hidden : UDINT; END_VAR"
    controller = run(files("self.hidden += 1", variables=variables))
    assert (value(controller, "main.hidden"), value(controller, "hidden")) == (3, 3)
    with pytest.raises(ConfigurationError, match="hidden is no variable"):
        run(files("self.hidden += 1", head="hidden = 0"))  # an attribute of the class hides it too


def test_the_checks_are_those_of_own_variables(run):
    with pytest.raises(ConfigurationError, match=r"main\.py:8: Main has no gCont; did you mean gC"):
        run(files("self.gCont += 1"))
    with pytest.raises(ConfigurationError, match=r"self\.gCount is UDINT and cannot be 'x'"):
        run(files('self.gCount = "x"'))
    with pytest.raises(ConfigurationError, match=r"Axis has no sped; did you mean speed\?"):
        run(files("self.gCount = self.gAxis.sped"))


def test_constants_cannot_be_written(run, value):
    controller = run(files("self.gCount = self.LIMIT + self.TABLE_[3]"))
    assert value(controller, "gCount") == 12
    controller = run(files('setattr(self, "LIMIT", 1)'))
    assert "LIMIT is CONSTANT" in str(controller.fault)
    with pytest.raises(ConfigurationError, match=r"main\.py:8: LIMIT is CONSTANT"):
        run(files("self.LIMIT = 1"))
    controller = run(files("self.TABLE_[3] = 7; self.gCount = self.TABLE_[3]"))
    assert value(controller, "gCount") == 3  # it was a copy
    assert value(controller, "TABLE_") == [1, 2, 3]


def test_constants_of_a_program(run, value):
    variables = "VAR CONSTANT LIMIT : UDINT := 2; END_VAR VAR x : UDINT; END_VAR"
    controller = run(files("self.x = self.LIMIT", variables=variables))
    assert (value(controller, "main.x"), value(controller, "main.LIMIT")) == (2, 2)
    assert controller.tags.find("main.LIMIT").is_constant


def test_var_external_tells_the_type(run, value):
    controller = run(files("self.gCount += 1", head="gCount = var_external(UDINT)"))
    assert value(controller, "gCount") == 8
    controller = run(files("self.gCount = self.LIMIT", head="LIMIT = var_external(UDINT)"))
    assert value(controller, "gCount") == 9
    with pytest.raises(ConfigurationError, match="LIMIT is CONSTANT"):
        run(files("self.LIMIT = 1", head="LIMIT = var_external(UDINT)"))


@pytest.mark.parametrize(
    ("head", "error"),
    [
        ("gCount = var_external(UINT)", "the global variable gCount is UDINT, not UINT"),
        ("gCont = var_external(UDINT)", "no global variable gCont; did you mean gCount?"),
        ("LIMIT = var_external(UINT)", "the global variable LIMIT is UDINT, not UINT"),
    ],
)
def test_var_external_is_compared_with_the_declaration(run, head, error):
    with pytest.raises(ConfigurationError) as raised:
        run(files("pass", head=head))
    assert error in str(raised.value)


def test_global_variables_may_be_a_class(run, value):
    more = {
        "Global.var": "",
        "globals.py": """
            from plcsim import Globals
            from st_types import UDINT, var

            class Cell(Globals):
                gCount = var(UDINT, 5)
        """,
    }
    controller = run(files("self.gCount += 1", more=more))
    assert value(controller, "gCount") == 8


def test_they_are_declared_in_one_place(run):
    text = "from plcsim import Globals\nclass Cell(Globals): ...\n"
    with pytest.raises(ConfigurationError, match=r"Global\.var:3:5: global variables are declared"):
        run(files("pass", more={"globals.py": text}))
    two = text + "class More(Globals): ...\n"
    with pytest.raises(ConfigurationError, match=r"one subclass of plcsim\.Globals is"):
        run(files("pass", more={"globals.py": two, "Global.var": ""}))


def test_a_module_of_that_name_may_hold_other_things(run, value):
    text = "from plcsim import Globals\nX = 4\n"
    controller = run(files("self.gCount = 1", more={"globals.py": text}))
    assert value(controller, "gCount") == 1


def test_a_constant_struct_is_a_copy_each_time():
    class Axis(Struct):
        speed = var(UDINT, 3)

    class Holder:
        axis = ConstantAttribute("axis", Axis._plc_type, {"speed": 7})
        plain = ConstantAttribute("plain", UDINT, 4)

    holder = Holder()
    holder.axis.speed = 1
    assert (holder.axis.speed, holder.plain) == (7, 4)
    assert isinstance(Holder.axis, ConstantAttribute)
    with pytest.raises(AttributeError, match="plain is CONSTANT"):
        holder.plain = 5
    assert isinstance(Axis._plc_type, StructType)
