import pytest

from plcsim.core.context import Context
from plcsim.core.errors import ConfigurationError
from plcsim.core.memory import PAGE, Memory
from plcsim.library.standard import R_TRIG
from plcsim.program.loader import installed_catalogue
from plcsim.program.site import Site
from st_types.types.derived import DataBlockType
from st_types.types.views import type_of


@pytest.fixture
def context():
    return Context(Memory(4 * PAGE), network=None)


def test_blocks_find_the_site_of_their_controller(context):
    with pytest.raises(RuntimeError, match="made without a site"):
        Site.of(context)
    site = Site(context, installed_catalogue())
    assert Site.of(context) is site
    assert site.memory is context.memory


def test_a_block_of_any_language_runs_on_the_data_block_at_an_address(context):
    site = Site(context, installed_catalogue())
    block = context.memory.new(R_TRIG, context)
    run = site.block(type_of(R_TRIG))
    assert site.block(type_of(R_TRIG)) is run
    block.CLK = True
    run(block._plc_address)
    assert block.Q
    run(block._plc_address)
    assert not block.Q


def test_a_block_without_a_body_is_named(context):
    site = Site(context, installed_catalogue())
    with pytest.raises(ConfigurationError, match="FUNCTION_BLOCK Ramp has no body"):
        site.block(DataBlockType("Ramp", ()))
