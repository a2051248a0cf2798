import io

import argon2
import pytest

from plcsim.access import Role, User, Users, users
from plcsim.cli.command import run_command


@pytest.fixture
def project(tmp_path, monkeypatch):
    hasher = argon2.PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
    monkeypatch.setattr(users, "_hasher", lambda: hasher)
    (tmp_path / "plc.toml").write_text("")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_users_are_added_listed_and_removed(project, monkeypatch, capsys):
    assert run_command(["users", "list"]) == 0
    assert "no users: only this machine" in capsys.readouterr().out
    monkeypatch.setattr("sys.stdin", io.StringIO("correct horse\n"))
    assert run_command(["users", "add", "anna", "--role", "operate"]) == 0
    assert "anna: operate" in capsys.readouterr().out
    known = Users(users.users_file(project))
    assert known.check("anna", "correct horse") == User("anna", Role.OPERATE)
    assert run_command(["users", "token", "nightly", "--project", str(project)]) == 0
    token = capsys.readouterr().out.strip()
    assert known.by_token(token) == User("nightly", Role.LOOK)
    assert run_command(["users", "list", str(project)]) == 0
    rows = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert rows == [
        ["name", "role", "kind"],
        ["anna", "operate", "user"],
        ["nightly", "look", "token"],
    ]
    assert run_command(["users", "remove", "anna"]) == 0
    assert known.find("anna") is None


def test_two_passwords_that_differ_change_nothing(project, monkeypatch, capsys):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    typed = iter(["correct horse", "correct house"])
    monkeypatch.setattr("sys.stdin", Terminal())
    monkeypatch.setattr("getpass.getpass", lambda _prompt: next(typed))
    assert run_command(["users", "add", "anna"]) == 1
    assert "the two passwords differ" in capsys.readouterr().err
    assert not users.users_file(project).exists()


def test_a_folder_that_is_no_project_has_no_users(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert run_command(["users", "list"]) == 1
    assert "plc.toml" in capsys.readouterr().err
