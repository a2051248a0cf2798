"""Retained variables over warm and cold restarts."""

import pytest

from plcsim import Program
from plcsim.testing.target import open_plc
from st_types import ARRAY, INT, UDINT, DataBlock, Struct, var


class Part(Struct):
    made = var(UDINT, retain=True)
    seen = var(UDINT)


class Counter(DataBlock):
    total = var(UDINT, retain=True)
    now = var(UDINT)


class Machine(Program):
    parts = var(UDINT, 7, retain=True)
    shift = var(UDINT, 7)
    table = var(ARRAY(INT, (1, 3)), [1, 2, 3], retain=True)
    part = var(Part)
    counters = var(ARRAY(Counter, (0, 1)))
    at_init = var(UDINT)

    def init(self) -> None:
        self.at_init = self.parts

    def cyclic(self) -> None:
        self.parts += 1
        self.shift += 1
        self.table[2] += 1
        self.part.made += 1
        self.part.seen += 1
        self.counters[1].total += 1
        self.counters[1].now += 1


@pytest.fixture
def ran():
    with open_plc(program=Machine) as made:
        made.run("50ms")
        assert (made["Machine.parts"], made["Machine.shift"]) == (12, 12)
        yield made


def values(plc):
    paths = ("parts", "shift", "table[2]", "part.made", "part.seen")
    blocks = ("counters[1].total", "counters[1].now", "counters[0].total")
    return [plc[f"Machine.{path}"] for path in (*paths, *blocks, "at_init")]


def test_a_warm_restart_keeps_what_is_retained(ran):
    ran.restart()
    assert values(ran) == [12, 7, 7, 5, 0, 5, 0, 0, 12]
    ran.run("10ms")
    ran.restart()
    assert ran["Machine.parts"] == 13


def test_a_cold_restart_clears(ran):
    ran.restart(cold=True)
    assert values(ran) == [7, 7, 2, 0, 0, 0, 0, 0, 7]


def test_permanent_variables_keep_their_values_even_then(ran):
    controller = ran.controller
    for path in ("Machine.shift", "Machine.table[2]"):
        controller.retained.add_permanent(controller.tags.find(path))
    assert [tag.path for tag in controller.retained.tags][-1] == "Machine.shift"
    ran.restart(cold=True)
    assert values(ran) == [7, 12, 7, 0, 0, 0, 0, 0, 7]
    ran.restart()
    assert values(ran) == [7, 12, 7, 0, 0, 0, 0, 0, 7]


def test_what_is_kept_before_the_first_boot_is_there_at_init():
    with open_plc(program=Machine) as first:
        first.run("10ms")
        first.controller.retained.keep()
        data = first.controller.retained.to_bytes()
    with open_plc(program=Machine) as plc:
        plc.controller.retained.from_bytes(data)
        plc.controller.shutdown()
        assert plc.controller.retained.to_bytes() == data


def test_what_is_retained_is_found_in_order():
    with open_plc(program=Machine) as plc:
        assert [tag.path for tag in plc.controller.retained.tags] == [
            "Machine.parts",
            "Machine.table",
            "Machine.part.made",
            "Machine.counters[0].total",
            "Machine.counters[1].total",
        ]
