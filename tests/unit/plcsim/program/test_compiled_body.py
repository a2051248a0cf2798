"""Bodies that are compiled, on a controller and while the module of theirs is being linked."""

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import PAGE, Memory
from plcsim.library.executable import CompiledExecutable
from plcsim.program.compiled_body import CompiledBody
from plcsim.program.loader import installed_catalogue
from plcsim.program.site import Site
from plcsim.program.structured_text.calling import interface_of


@pytest.fixture
def site():
    return Site(Context(Memory(4 * PAGE), network=None), installed_catalogue())


class Late:
    """The C library, not there when it is first asked for."""

    language = "C"

    def __init__(self, code):
        self._code = code
        self.asked = 0

    def on(self, site):
        self.asked += 1
        return None if self.asked == 1 else self._code.on(site)


@pytest.fixture
def body_of(site):
    """``body_of(name)``: the body of a block or a function, which is linked late."""

    def body_of(name):
        found = site.catalogue.find_block(name) or site.catalogue.find_function(name)
        body = found[1]
        assert isinstance(body, CompiledExecutable)
        return CompiledBody(Late(body.library), body.name, body.interface)

    return body_of


def test_a_block_that_is_bound_while_its_module_is_linked_runs_later(site, body_of):
    body = body_of("R_TRIG")
    assert body.language == "C"
    run = body.bind(site.context)
    address = site.memory.allocate(4, 4)
    site.memory.write(address, b"\1")
    run(address)
    assert site.memory.read(address, 3) == b"\1\1\1"
    run(address)
    assert site.memory.read(address, 3) == b"\1\0\1"


def test_a_function_likewise(site, body_of):
    address = site.memory.keep(b"four\0", 1)
    assert body_of("LEN").bind(site.context)(address) == 4
    function = site.catalogue.find_function("LEN")[0].scope.find_function("LEN")
    assert body_of("LEN").interface == interface_of(function)


@pytest.mark.parametrize("name", ["TON", "LEN", "CONCAT"])
def test_others_import_it_by_way_of_python_until_it_is_linked(site, body_of, name):
    body = body_of(name)
    by_python, direct = body.extern(site.context), body.extern(site.context)
    assert by_python is not direct
    assert by_python.type == direct.type
