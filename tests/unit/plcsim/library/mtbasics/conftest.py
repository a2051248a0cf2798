"""Blocks that are called in a class of 10 ms."""

import pytest


@pytest.fixture
def run(plc):
    """``run(block, values, name="Out", **inputs)``: one call for each value of In."""
    plc.controller.scan.active = plc.controller.tasks[0]

    def run(block, values, name="Out", at="In", **inputs):
        found = []
        for value in values:
            block(Enable=True, **{at: value}, **inputs)
            found.append(getattr(block, name))
        return found

    return run
