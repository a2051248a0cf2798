"""Diagnostics and adjustable values by handles."""

import pytest

from crosnode.interface import upkeep
from crosnode.interface.interface import (
    CrosAdjustableKind,
    crosERR_FULL,
    crosERR_HANDLE,
    crosERR_VALUE,
)
from crosnode.upkeep.diagnostics import MOST_COMPONENTS, MOST_VALUES

from .site import Site

BOOL, INT, REAL = CrosAdjustableKind
"""In the order of their declaration."""


def test_a_component_with_its_values(site: Site) -> None:
    told = site.other.register_subscriber("/diagnostics", "diagnostic_msgs/DiagnosticArray")
    made = upkeep.diagnostics(site.context, site.node, site.text("plc-1"))
    name = site.text("drives")
    assert upkeep.value(site.context, made, name, site.text("A"), site.text("1.5")) == 0
    assert upkeep.set_component(site.context, made, name, 2, site.text("hot")) == 0
    site.world.until(lambda: told.queue)
    message = told.pop()
    assert message is not None
    (status,) = message.status
    assert (status.name, status.level, status.message) == ("cell/plc: drives", 2, "hot")
    assert status.hardware_id == "plc-1"
    assert [(each.key, each.value) for each in status.values] == [("A", "1.5")]
    assert upkeep.set_component(site.context, made, name, 9, name) == crosERR_VALUE


def test_components_and_values_are_bounded(site: Site) -> None:
    made = upkeep.diagnostics(site.context, site.node, site.text(""))
    one = site.text("one")
    for number in range(MOST_VALUES):
        assert upkeep.value(site.context, made, one, site.text(f"{number}"), one) == 0
    assert upkeep.value(site.context, made, one, one, one) == crosERR_FULL
    for number in range(MOST_COMPONENTS):
        name = site.text(f"{number}")
        assert upkeep.set_component(site.context, made, name, 0, one) == 0
    assert upkeep.set_component(site.context, made, one, 0, one) == crosERR_FULL


def test_values_that_others_change(site: Site) -> None:
    def declare(name: str, kind: int, value: float) -> int:
        return upkeep.adjustable(
            site.context, site.node, site.text(name), kind, value, 0.0, 10.0, site.text("")
        )

    speed, count, on = declare("speed", REAL, 0.5), declare("count", INT, 3), declare("on", BOOL, 1)
    assert speed
    assert count
    assert on
    assert declare("speed", REAL, 0.5) == 0  # the name is taken
    assert declare("fast", REAL, 11.0) == 0  # beyond its bounds
    assert declare("nan", INT, float("nan")) == 0
    assert declare("kind", 9, 0.0) == 0
    caller = site.other.register_service_caller(
        "/cell/plc/set_parameters", "dynamic_reconfigure/Reconfigure"
    )
    site.world.run(200)
    assert declare("late", REAL, 1.0) == 0
    request = caller.new()
    types = site.other.types
    request.config.ints = [types.message("dynamic_reconfigure/IntParameter").new(
        name="count", value=99)]  # fmt: skip
    request.config.bools = [types.message("dynamic_reconfigure/BoolParameter").new(
        name="on", value=False)]  # fmt: skip
    caller.call(request)
    site.world.until(lambda: caller.replies)
    assert upkeep.adjustable_value(site.context, count) == 10.0
    assert upkeep.adjustable_value(site.context, on) == 0.0
    assert upkeep.adjustable_value(site.context, speed) == 0.5
    assert upkeep.set_adjustable(site.context, speed, 20.0) == 0
    assert upkeep.adjustable_value(site.context, speed) == 10.0
    assert upkeep.set_adjustable(site.context, count, float("inf")) == crosERR_VALUE


@pytest.mark.parametrize("handle", [0, 99])
def test_what_is_no_handle_is_refused(site: Site, handle: int) -> None:
    text = site.text("")
    assert upkeep.diagnostics(site.context, handle, text) == 0
    assert upkeep.value(site.context, handle, text, text, text) == crosERR_HANDLE
    assert upkeep.set_component(site.context, handle, text, 0, text) == crosERR_HANDLE
    assert upkeep.adjustable(site.context, handle, text, 0, 0.0, 0.0, 0.0, text) == 0
    assert upkeep.adjustable_value(site.context, handle) == 0.0
    assert upkeep.set_adjustable(site.context, handle, 1.0) == crosERR_HANDLE
