"""The catalogue: who declares a block or a function, what executes it, what it may be told."""

from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.library.astcp.settings import AsTcpSettings
from plcsim.library.catalogue import Catalogue
from plcsim.library.installed import installed
from plcsim.library.library import Library
from plcsim.library.simulated import Rules, built_in_rules
from plcsim.settings import Table


class Body:
    def __init__(self, language, name):
        self.language = language
        self.name = name

    def bind(self, context):
        raise AssertionError("nothing runs here")


class Spoken:
    """A language with bodies for these names in the library ``ramps``."""

    def __init__(self, name, *bodies):
        self.name = name
        self._bodies = {body: Body(name, body) for body in bodies}
        self.asked = []

    def bodies(self, library):
        self.asked.append(library.name)
        return self._bodies if library.name == "ramps" else {}


@pytest.fixture
def catalogue(library):
    """``catalogue(*languages)``: of the library of this folder and those that are installed."""
    return lambda *languages: Catalogue([library, *installed().values()], languages)


def test_blocks_and_functions_are_found_with_their_bodies(catalogue, library):
    found = catalogue(Spoken("A", "Ramp"), Spoken("B", "twice"))
    assert found.find_block("Ramp")[0] is library
    assert found.find_block("Ramp")[1].language == "A"
    assert found.find_function("twice")[1].language == "B"
    assert found.executable(library.scope.find_type("Ramp")).name == "Ramp"


def test_what_is_not_declared_or_has_no_body(catalogue, library):
    found = catalogue(Spoken("A"))
    assert found.find_block("Ramp") == (library, None)
    assert found.find_block("twice") is found.find_function("Ramp") is None
    assert found.executable(library.scope.find_type("Ramp")) is None
    stranger = Library(library.folder, "other").scope.find_type("Axis")
    assert found.executable(stranger) is None


def test_bodies_are_loaded_when_one_is_asked_for_and_once(catalogue):
    language = Spoken("A", "Ramp")
    found = catalogue(language)
    assert language.asked == []
    found.find_block("Ramp")
    found.find_block("Ramp")
    assert language.asked == ["ramps"]


def test_one_declaration_has_one_body(catalogue, library):
    found = catalogue(Spoken("Python", "Ramp"), Spoken("ANSI C", "Ramp"))
    with pytest.raises(ConfigurationError) as raised:
        found.find_block("Ramp")
    text = "Ramp has a body in Python and one in ANSI C"
    assert str(raised.value) == f"{library.folder}: {text}"


def tables(**values):
    return Table(Path("plc.toml"), "library", values).tables()


def test_the_settings_of_a_library_are_its_own(catalogue):
    settings = catalogue().read_settings(tables(AsTCP={"idents": 3}))
    assert settings == [AsTcpSettings(idents=3)]


def test_wrong_tables_are_told_in_one_go(catalogue):
    with pytest.raises(ConfigurationError) as raised:
        catalogue().read_settings(tables(astcp={}, standard={}, AsTCP={"idents": 0}))
    assert raised.value.findings == (
        "plc.toml: library.astcp: there is no such library; did you mean AsTCP?",
        "plc.toml: library.standard: this library has no settings",
        "plc.toml: library.AsTCP.idents: 0 is outside 1..65535",
    )


def test_what_has_no_body_is_idle_in_a_library_of_stubs(library):
    found = Catalogue([library], [Spoken("A", "Ramp")], ["ramps"])
    assert found.find_block("Ramp")[1].language == "A"
    assert found.stubbed == {}
    stub = found.find_function("twice")[1]
    assert (stub.language, stub.bind(None)(4)) == ("stub", 0)
    assert {name: [*names] for name, names in found.stubbed.items()} == {"ramps": ["twice"]}
    assert Catalogue([library], []).find_function("twice")[1] is None


def test_a_rule_gives_a_function_a_result(library):
    rules = Rules({}, {"twice": {"twice": 7, "Done": "Execute"}})
    found = Catalogue([library], [], ["ramps"], rules)
    body = found.find_function("twice")[1]
    assert (body.language, body.bind(None)(4)) == ("table", 7)
    assert found.stubbed == {"ramps": {"twice": "returns 7"}}


@pytest.mark.parametrize("rule", [{"twice": "Execute"}, {"Done": True}])
def test_what_is_no_result_leaves_a_function_idle(library, rule):
    found = Catalogue([library], [], ["ramps"], Rules({}, {"twice": rule}))
    assert found.find_function("twice")[1].language == "stub"


def test_a_block_of_motion_moves_an_axis_unless_the_project_has_rules_for_it(tmp_path):
    (tmp_path / "McAxis.fun").write_text(
        "FUNCTION_BLOCK MC_Power\nVAR_INPUT\nAxis : UDINT;\nEnable : BOOL;\nEND_VAR\n"
        "VAR_OUTPUT\nStatus : BOOL;\nEND_VAR\nEND_FUNCTION_BLOCK\n"
    )
    library = Library(tmp_path, "motion")
    found = Catalogue([library], [], ["mcaxis"])
    assert found.find_block("MC_Power")[1].language == "model"
    assert found.stubbed == {"McAxis": {"MC_Power": "an axis with trapezoidal profile"}}
    rules = built_in_rules().extended({"MC_Power": {"Status": "Enable"}})
    assert Catalogue([library], [], ["mcaxis"], rules).find_block("MC_Power")[1].language == "table"
    assert Catalogue([library], []).find_block("MC_Power")[1] is None


def test_bodies_that_are_wrong_are_loaded_once_and_told_each_time(library):
    class Wrong(Spoken):
        def bodies(self, library):
            self.asked.append(library.name)
            raise ConfigurationError("a.c:1: wrong", "a.c:2: wrong too")

    language = Wrong("A")
    found = Catalogue([library], [language])
    for _ in range(2):
        with pytest.raises(ConfigurationError) as raised:
            found.bodies(library)
        assert raised.value.findings == ("a.c:1: wrong", "a.c:2: wrong too")
    assert language.asked == ["ramps"]
