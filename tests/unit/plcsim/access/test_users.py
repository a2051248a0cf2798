import json

import argon2
import pytest

from plcsim.access import Role, User, Users, UsersError, users


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    """Hashes that take no time; what makes them slow is argon2's own."""
    hasher = argon2.PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
    monkeypatch.setattr(users, "_hasher", lambda: hasher)
    users._nobody.cache_clear()
    yield
    users._nobody.cache_clear()


@pytest.fixture
def file(tmp_path):
    return users.users_file(tmp_path)


def test_a_user_is_known_by_name_and_password(file):
    known = Users(file)
    assert not known
    known.add("anna", Role.ENGINEER, "correct horse")
    assert known
    assert known.check("anna", "correct horse") == User("anna", Role.ENGINEER)
    assert known.check("anna", "correct hors") is None
    assert known.check("bert", "correct horse") is None
    assert known.find("anna") == User("anna", Role.ENGINEER)
    assert "correct horse" not in file.read_text()
    assert json.loads(file.read_text())["users"]["anna"]["password"].startswith("$argon2id$")
    assert file.stat().st_mode & 0o777 == 0o600


def test_another_process_sees_a_change_at_its_next_look(file):
    here, there = Users(file), Users(file)
    here.add("anna", Role.LOOK, "correct horse")
    assert there.find("anna") == User("anna", Role.LOOK)
    here.add("anna", Role.OPERATE, "battery staple")
    assert there.check("anna", "battery staple") == User("anna", Role.OPERATE)
    assert there.check("anna", "correct horse") is None
    here.remove("anna")
    assert there.find("anna") is None
    assert there.check("anna", "battery staple") is None


def test_a_token_stands_for_a_role_and_is_not_kept(file):
    known = Users(file)
    token = known.add_token("nightly", Role.LOOK)
    assert known.by_token(token) == User("nightly", Role.LOOK)
    assert known.by_token(token[:-1]) is None
    assert known.by_token("") is None
    assert token not in file.read_text()
    assert known.all() == [("token", User("nightly", Role.LOOK))]
    known.remove("nightly")
    assert known.by_token(token) is None


@pytest.mark.parametrize("name", ["", "a b", "<b>", "-a", "a" * 65, "ä", "a/b", "a\n"])
def test_names_are_plain(file, name):
    with pytest.raises(UsersError, match="is no name"):
        Users(file).add(name, Role.LOOK, "correct horse")


@pytest.mark.parametrize(("password", "why"), [("1234567", "at least 8"), ("x" * 1025, "at most")])
def test_a_password_has_a_length(file, password, why):
    with pytest.raises(UsersError, match=why):
        Users(file).add("anna", Role.LOOK, password)
    assert not file.exists()


def test_who_is_not_there_cannot_be_removed(file):
    with pytest.raises(UsersError, match="no user and no token bert"):
        Users(file).remove("bert")


def test_a_file_that_others_may_read_is_not_used(file):
    known = Users(file)
    known.add("anna", Role.LOOK, "correct horse")
    file.chmod(0o644)
    file.touch()
    with pytest.raises(UsersError, match="others may read it"):
        Users(file).find("anna")


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"users": {"a": {}}, "tokens": {}}', '{"users": [], "tokens": {}}',
     '{"users": {"a": {"role": "king", "password": "x"}}, "tokens": {}}',
     '{"users": {"a": {"role": "look", "password": 7}}, "tokens": {}}'],
)  # fmt: skip
def test_a_damaged_file_lets_nobody_in(file, text):
    file.parent.mkdir()
    file.write_text(text)
    file.chmod(0o600)
    with pytest.raises(UsersError, match="is damaged"):
        bool(Users(file))
