import asyncio
import json
from types import SimpleNamespace

import argon2
import pytest

from plcsim.access import Role, users
from plcsim.web.service import door
from plcsim.web.service.app import FRONT, LARGEST_MESSAGE

from ..site import Socket, World, request

ORIGIN = {"origin": "http://localhost:8080"}


def ask(world, *arguments, **options):
    return world.do(lambda: request(world, *arguments, **options))


@pytest.fixture
def guarded(tmp_path, monkeypatch):
    """A world with users."""
    hasher = argon2.PasswordHasher(time_cost=1, memory_cost=8, parallelism=1)
    monkeypatch.setattr(users, "_hasher", lambda: hasher)
    users._nobody.cache_clear()
    world = World(tmp_path)
    world.users.add("anna", Role.ENGINEER, "correct horse")
    world.users.add("otto", Role.LOOK, "battery staple")
    yield world
    users._nobody.cache_clear()


def log_in(world, name="anna", password="correct horse"):
    answer = ask(world, "POST", "/login", {"name": name, "password": password}, headers=ORIGIN)
    cookie = answer.headers.get("set-cookie", "")
    return answer, {"cookie": cookie.partition(";")[0], **ORIGIN}


def test_the_pages_are_files_that_load_nothing_from_elsewhere(world):
    for path in ("/", "/main.js", "/style.css", "/vendor/uplot/uPlot.iife.min.js", "/icon.svg"):
        answer = ask(world, "GET", path)
        assert answer.status == 200
        assert "default-src 'none'" in answer.headers["content-security-policy"]
        assert answer.headers["x-content-type-options"] == "nosniff"
    tag = answer.headers["etag"]
    assert ask(world, "GET", "/icon.svg", headers={"if-none-match": tag}).status == 304
    for path in ("/nothing.js", "/../settings.py", "/vendor", "/pages/../main.js"):
        assert ask(world, "GET", path).status == 404
    texts = [file.read_text() for file in FRONT.rglob("*") if file.suffix in (".js", ".html")]
    assert not [text for text in texts if "innerHTML" in text and "uPlot" not in text]


def test_a_page_weighs_less_than_half_a_megabyte():
    weight = sum(f.stat().st_size for f in FRONT.rglob("*") if f.suffix in (".js", ".css", ".html"))
    assert weight < 500_000


def test_a_script_on_this_machine_works_without_users(world):
    answer = ask(world, "POST", "/api/read", {"tags": ["p.level"]})
    assert answer.json()["values"] == [1.5]
    answer = ask(world, "POST", "/api/write", {"tag": "p.level", "value": "3.5"})
    assert answer.json()["before"] == "1.5"
    answer = ask(world, "POST", "/api/write", {"tag": "p.level", "value": "x"})
    assert answer.status == 400
    assert "x" in answer.json()["error"]


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:8080", "", "localhost.evil.example"]
)
def test_nobody_asks_by_a_name_that_is_not_ours(world, host):
    assert ask(world, "GET", "/", headers={"host": host}).status == 421


@pytest.mark.parametrize("host", ["localhost:1", "127.0.0.1:8080", "[::1]:8080", "192.168.1.7"])
def test_addresses_and_own_names_are_ours(world, host):
    assert ask(world, "GET", "/", headers={"host": host}).status == 200


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "http://evil.example"},
        {"origin": "null"},
        {"origin": "https://localhost:8080"},
        {"origin": "http://localhost:8081"},
        {"sec-fetch-site": "cross-site"},
        {"sec-fetch-site": "same-site"},
    ],
)
def test_pages_of_other_sites_are_refused(world, headers):
    answer = ask(world, "POST", "/api/write", {"tag": "p.level", "value": "9.0"}, headers=headers)
    assert answer.status == 403
    assert world.value("p.level") == 1.5


def test_a_form_of_another_site_is_no_json(world):
    answer = ask(world, "POST", "/api/stop", headers={"content-type": "text/plain"})
    assert answer.status == 415
    assert not world.plc.requests


@pytest.mark.parametrize("body", [b"{", b"[]", b"7", b"\xff", b"[" * 100_000])
def test_what_is_no_object_of_json_is_refused(world, body):
    assert ask(world, "POST", "/api/read", body=body).status == 400


def test_a_body_that_is_too_long_is_not_kept(world):
    answer = ask(world, "POST", "/api/read", body=b" " * (LARGEST_MESSAGE + 1))
    assert answer.status == 413


def test_with_users_nobody_gets_in_without_a_password(guarded):
    assert ask(guarded, "POST", "/api/read", {"tags": []}).status == 401
    assert ask(guarded, "GET", "/").status == 200  # the page that asks who one is
    wrong, _ = log_in(guarded, password="wrong horse")
    assert (wrong.status, wrong.json()["error"]) == (401, "name or password is wrong")
    nobody, _ = log_in(guarded, name="emil")
    assert nobody.json() == wrong.json()


def test_a_login_lasts_until_its_end(guarded):
    answer, headers = log_in(guarded)
    assert answer.json() == {"name": "anna", "role": "engineer"}
    flags = answer.headers["set-cookie"].lower()
    assert "httponly" in flags
    assert "samesite=strict" in flags
    assert ask(guarded, "POST", "/api/read", {"tags": []}, headers=headers).status == 200
    del headers["origin"]
    assert ask(guarded, "POST", "/api/read", {"tags": []}, headers=headers).status == 403
    headers |= ORIGIN
    assert ask(guarded, "POST", "/logout", headers=headers).status == 200
    assert ask(guarded, "POST", "/api/read", {"tags": []}, headers=headers).status == 401


def test_who_only_looks_writes_nothing(guarded):
    _, headers = log_in(guarded, "otto", "battery staple")
    values = {"tag": "p.level", "value": "9.0"}
    answer = ask(guarded, "POST", "/api/write", values, headers=headers)
    assert (answer.status, guarded.value("p.level")) == (403, 1.5)
    assert "the role look may not" in answer.json()["error"]


def test_who_is_removed_is_out_at_once(guarded):
    _, headers = log_in(guarded)
    guarded.users.remove("anna")
    assert ask(guarded, "POST", "/api/read", {"tags": []}, headers=headers).status == 401


def test_tokens_are_for_scripts(guarded):
    token = guarded.users.add_token("nightly", Role.OPERATE)
    headers = {"authorization": f"Bearer {token}"}
    values = {"tag": "p.level", "value": "4.5"}
    assert ask(guarded, "POST", "/api/write", values, headers=headers).status == 200
    assert guarded.audit()[-1]["who"] == "nightly"
    for wrong in ("Bearer", f"Bearer {token}x", f"Basic {token}", "x" * 10_000):
        answer = ask(guarded, "POST", "/api/read", {"tags": []}, headers={"authorization": wrong})
        assert answer.status == 401


def test_who_guesses_has_to_wait(guarded, monkeypatch):
    now_s = 100.0
    monkeypatch.setattr(door, "time", SimpleNamespace(monotonic=lambda: now_s))
    for _ in range(5):
        log_in(guarded, password="wrong horse")
    answer, _ = log_in(guarded)
    assert answer.status == 429
    assert answer.json()["error"] == "too many wrong passwords; wait 1 s"
    now_s += 1
    answer, _ = log_in(guarded)
    assert answer.status == 200


def test_a_browser_is_told_what_it_watches(world):
    async def act():
        async with Socket(world) as socket:
            hello = await socket.pushed("hello")
            assert hello["user"] == {"name": "local", "role": "engineer", "has_users": False}
            assert hello["facts"]["project"] == "virtual"
            assert (await socket.ask("watch", tags=["p.level", "p.count"]))["ok"] == {"count": 2}
            values = dict((await socket.pushed("values"))["values"])
            assert values[0] == 1.5
            await socket.ask("write", tag="p.level", value="6.25")
            while dict((await socket.pushed("values"))["values"]).get(0) != 6.25:
                pass
            await socket.ask("force", tag="p.small", value="3")
            while not (await socket.pushed("forces"))["forces"]:
                pass

    world.do(act)
    assert world.hub.values._watched == {}
    assert len(world.hub.forces()) == 1  # who goes in the middle leaves what he forced, marked


def test_messages_that_make_no_sense_are_answered(world):
    async def act():
        async with Socket(world) as socket:
            await socket.pushed("hello")
            assert "no act" in (await socket.ask("fly"))["error"]
            assert "levl" in (await socket.ask("watch", tags=["p.levl"]))["error"]
            assert "topic" in (await socket.ask("follow", topics=["<b>"]))["error"]
            for text in ("", "{", "[]", "7", '{"do": 7}', "[" * 100_000, '{"id": {}, "do": "x"}'):
                await socket.tell(text)
            assert (await socket.ask("read", tags=["p.level"]))["ok"]["values"] == [1.5]

    world.do(act)


def test_a_page_of_another_site_gets_no_socket(world):
    async def act(origin):
        async with Socket(world, {"origin": origin}) as socket:
            return socket.is_accepted

    assert world.do(lambda: act("http://evil.example")) is False
    assert world.do(lambda: act("http://localhost:8080")) is True


def test_who_is_logged_out_is_let_go(guarded):
    async def stranger():
        async with Socket(guarded) as socket:
            return await socket.closed()

    async def removed(headers):
        async with Socket(guarded, headers) as socket:
            await socket.pushed("hello")
            guarded.users.remove("anna")
            return await socket.closed()

    assert guarded.do(stranger) == 4401
    _, headers = log_in(guarded)
    assert guarded.do(lambda: removed(headers)) == 4401


def test_a_wrong_token_gets_no_socket(guarded):
    async def act():
        async with Socket(guarded, {"authorization": "Bearer nobody.knows"}) as socket:
            return await socket.closed()

    assert guarded.do(act) == 4401


def test_a_force_outlives_the_session_that_ends_in_the_middle_of_it(world):
    """It is whole: forced, listed with who, in the audit log, and for somebody else to release."""

    async def leave():
        async with Socket(world) as socket:
            await socket.pushed("hello")
            force = {"id": 1, "do": "force", "tag": "p.level", "value": "2.5"}
            await socket.tell(json.dumps(force))
            while not world.hub.acting:
                await asyncio.sleep(0)
        while world.hub.acting:
            await asyncio.sleep(0)

    world.do(leave)
    assert world.hub.forces() == [{"path": "p.level", "value": "2.5", "by": "web: local"}]
    assert world.value("p.level") == 2.5
    (line,) = world.audit()
    assert (line["act"], line["tag"], line["who"]) == ("force", "p.level", "local")
    assert ask(world, "POST", "/api/release", {"tag": "p.level"}).status == 200
    assert world.hub.forces() == []


@pytest.mark.parametrize("value", ["</script><b>$'", "$0D$0A$1B[31m$00", "a$Nb$Tc"])
def test_markup_and_control_characters_are_values_like_others(world, value):
    """They come as JSON, never as HTML, and are one line of the audit log."""
    answer = ask(world, "POST", "/api/write", {"tag": "p.name", "value": f"'{value}'"})
    assert (answer.status, answer.headers["content-type"]) == (200, "application/json")
    shown = ask(world, "POST", "/api/read", {"tags": ["p.name"]}).json()["values"]
    assert shown == [world.value("p.name")]
    assert len(world.audit()) == 1
    for path in ("p.<b>x</b>", "p.\x00\x1b", "p.na\u202eme"):
        refused = ask(world, "POST", "/api/write", {"tag": path, "value": "'x'"})
        assert (refused.status, refused.headers["content-type"]) == (400, "application/json")
    assert len(world.audit()) == 1


def test_a_browser_that_reads_nothing_holds_nothing_up(world):
    """Its next values wait for the last ones; what it asks waits for the answers before."""

    async def act():
        sent = []

        async def receive():
            if not sent:
                return {"type": "websocket.connect"}
            await asyncio.sleep(0)
            return {
                "type": "websocket.receive",
                "text": json.dumps({"do": "watch", "tags": ["p.count"]}),
            }

        async def send(message):
            sent.append(message)
            if message["type"] == "websocket.send":
                await asyncio.sleep(3600)

        socket = Socket(world)
        serving = asyncio.create_task(world.app(socket._scope, receive, send))
        while len(sent) < 2:
            await asyncio.sleep(0.01)
        await asyncio.sleep(0.3)  # nothing more comes
        serving.cancel()
        await asyncio.gather(serving, return_exceptions=True)
        return sent

    sent = world.do(act)
    assert [message["type"] for message in sent] == ["websocket.accept", "websocket.send"]
