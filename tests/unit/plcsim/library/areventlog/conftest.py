"""Blocks with Execute, called until they are done."""

import pytest


@pytest.fixture
def do(plc):
    """``do(Block, Name="x")``: call a block with Execute until it is done."""

    def do(view, **inputs):
        block = plc.new(view)
        block(Execute=True, **inputs)
        for _ in range(3):
            if block.Done or block.Error:
                return block
            assert block.Busy
            block()
        raise AssertionError("it is never done")

    return do
