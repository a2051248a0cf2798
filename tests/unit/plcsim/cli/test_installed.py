"""Commands that other packages bring."""

from importlib.metadata import EntryPoint

from plcsim.cli import installed
from plcsim.cli.main import main


def test_a_command_that_cannot_be_imported_costs_only_itself(monkeypatch, capsys):
    broken = EntryPoint("fly", "plcsim_no_such_module:register", installed.COMMANDS)
    monkeypatch.setattr(
        installed, "entry_points", lambda group: [broken] if group == installed.COMMANDS else []
    )
    assert main(["check", "/nowhere"]) == 1
    first, second = capsys.readouterr().err.splitlines()
    assert first.startswith("plcsim: the command fly is not there: No module named")
    assert second.startswith("plcsim: /nowhere/plc.toml: there is no such file")
