"""Libraries that come with plcsim or with other packages."""

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.library import installed as module
from plcsim.library.installed import Scopes, installed


class Entry:
    def __init__(self, name, value):
        self.name = name
        self.value = value


@pytest.fixture
def entries(monkeypatch):
    """``entries(**{name: package})``: the installed libraries with these entry points."""

    def entries(**named):
        found = [Entry(*each) for each in named.items()]
        monkeypatch.setattr(module, "entry_points", lambda group: found)
        return installed.__wrapped__()

    return entries


def test_those_of_plcsim_are_there_under_their_packages():
    names = {package: library.name for package, library in installed().items()}
    assert names["plcsim.library.standard"] == "standard"
    assert names["plcsim.library.astcp"] == "AsTCP"
    assert names["plcsim.library.runtime"] == "runtime"


def test_they_have_no_errors_and_see_one_another():
    for library in installed().values():
        library.scope.check()
        assert [str(d) for f in library.scope.files for d in f.diagnostics.records] == []
        assert library.scope.find_type("TON") is not None


def test_a_package_brings_one_by_an_entry_point(entries, tmp_path, monkeypatch):
    folder = tmp_path / "some_package" / "ramps"
    folder.mkdir(parents=True)
    (folder / "ramps.fun").write_text("FUNCTION_BLOCK Ramp END_FUNCTION_BLOCK\n")
    monkeypatch.syspath_prepend(tmp_path)
    found = entries(ramps="some_package.ramps")["some_package.ramps"]
    assert (found.name, found.folder) == ("ramps", folder)
    assert found.scope.find_function_block("Ramp")


@pytest.mark.parametrize("package", ["nowhere_at_all", "nowhere_at_all.inside", "zlib"])
def test_an_entry_point_that_leads_nowhere_is_named(entries, package):
    with pytest.raises(ConfigurationError, match=r"entry point plcsim\.libraries: ramps: "):
        entries(ramps=package)


def test_scopes_are_read_when_they_are_asked_for():
    class Lazy:
        read = 0

        @property
        def scope(self):
            self.read += 1
            return self

    libraries = [Lazy(), Lazy()]
    scopes = Scopes(libraries)
    assert len(scopes) == 2
    assert scopes[1] is libraries[1]
    assert [each.read for each in libraries] == [0, 1]
    assert list(reversed(scopes)) == libraries[::-1]
    assert list(scopes[:1]) == libraries[:1]
