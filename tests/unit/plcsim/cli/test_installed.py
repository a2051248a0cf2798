"""Commands that other packages bring."""

from importlib.metadata import EntryPoint

import pytest

from plcsim.cli import installed
from plcsim.cli.main import main


def test_a_command_that_cannot_be_imported_costs_only_itself(monkeypatch, capsys):
    broken = EntryPoint("fly", "plcsim_no_such_module:register", installed.COMMANDS)
    monkeypatch.setattr(
        installed, "entry_points", lambda group: [broken] if group == installed.COMMANDS else []
    )
    with pytest.raises(SystemExit, match="0"):
        main(["--help"])
    shown = capsys.readouterr()
    assert shown.err.startswith("plcsim: the command fly is not there: No module named")
    assert "usage: plcsim" in shown.out
    assert main(["check", "/nowhere"]) == 1
    assert capsys.readouterr().err.startswith("plcsim: /nowhere/plc.toml: there is no such file")
