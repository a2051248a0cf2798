import pytest

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.headers import INCLUDE
from plcsim.ansi_c.toolchain import find_toolchain, system_clang, zig
from plcsim.core.errors import ConfigurationError
from plcsim.machine import CodeCache


def _needed(found):
    if found is None:
        pytest.skip("this compiler is not installed")
    return found


@pytest.fixture(params=[zig, system_clang], ids=["zig", "clang"])
def each_toolchain(request):
    """Every compiler that there may be, those that are not installed skipped."""
    return _needed(request.param())


@pytest.fixture
def toolchain():
    """The compiler that a user would get."""
    try:
        return find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


@pytest.fixture
def source(tmp_path):
    """``source("a.c", "int x;")``: a file."""

    def source(name, text):
        file = tmp_path / "program" / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
        return file

    return source


@pytest.fixture
def built(source, toolchain):
    """``built("int x;")``: what a file of C becomes, built without a cache."""

    def built(text, name="main.c", with_=toolchain):
        order = BuildOrder("program", [source(name, text)], [INCLUDE])
        return build(order, with_, CodeCache(None))

    return built
