"""A BOOL takes no text, in tests."""

import pytest

from plcsim import Program
from plcsim.testing.bools import check_bools
from plcsim.testing.errors import ControllerFault
from plcsim.testing.target import open_plc
from st_types import ARRAY, BOOL, STRING, Struct, ValueRangeError, var


class Lamp(Struct):
    on = var(BOOL)


class Lamps(Program):
    given = var(STRING(10))
    red = var(BOOL)
    one = var(Lamp)
    many = var(ARRAY(Lamp, (1, 2)))
    where = var(STRING(10), "red")

    def cyclic(self) -> None:
        if self.where == "red":
            self.red = self.given
        elif self.where == "one":
            self.one.on = self.given
        else:
            self.many[2].on = self.given


@pytest.mark.parametrize(("where", "name"), [("red", "red"), ("one", "on"), ("many", "on")])
def test_a_text_for_a_bool_is_a_fault_where_the_source_did_not_tell(where, name):
    with open_plc(program=Lamps) as plc:
        plc["Lamps.where"] = where
        plc["Lamps.given"] = "ja"
        with pytest.raises(ControllerFault, match=f"{name} is BOOL and cannot be 'ja'"):
            plc.run("20ms")


class Right(Program):
    on = var(BOOL)
    number = var(BOOL)

    def cyclic(self) -> None:
        self.on = not self.on
        self.number = int(self.on)


def test_a_bool_takes_truths_and_reads_as_one():
    with open_plc(program=Right) as plc:
        plc.run("10ms")
        assert plc["Right.on"] is True
        assert plc["Right.number"] is True
        check_bools(plc.controller.areas)  # once more changes nothing
        plc.run("10ms")
        assert plc["Right.on"] is False


def test_a_view_of_its_own_is_checked_too():
    class Own(Struct):
        on = var(BOOL)

    class Holder(Program):
        own = var(Own)

    with open_plc(program=Holder):
        own = Own()
        with pytest.raises(ValueRangeError, match="on is BOOL and cannot be 2"):
            own.on = 2
        own.on = True
        assert own.on is True
