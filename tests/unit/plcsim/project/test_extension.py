from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import pytest

from plcsim.core.controller import Controller
from plcsim.core.errors import ConfigurationError
from plcsim.project import extension
from plcsim.project import plc_toml as project
from plcsim.project.extension import Attachment, Extension, check_settings, services_of
from plcsim.project.plc_toml import read_project
from plcsim.settings import Table, Whole, settings

TOML = '[task_class.1]\ncycle = "10ms"\nprograms = ["p"]\n'


@settings
class WebSettings:
    port: Annotated[int, Whole(1, 65535)] = 80


class Web(Extension):
    def service(self, settings: int) -> str:
        return "service_for_tests"

    def read(self, table: Table) -> int:
        return table.read(WebSettings).port

    def attach(self, settings: Any, controller: Controller) -> Attachment:
        return Attachment(settings)


class Quiet(Web):
    """One whose settings say whether it has a service."""

    def service(self, settings: int) -> str:
        return super().service(settings) if settings == 4321 else ""

    def in_process(self, settings: int, ip: str) -> int:
        return settings + len(ip)


@pytest.fixture(autouse=True)
def installed(monkeypatch: pytest.MonkeyPatch) -> None:
    found = {"web": Web(), "quiet": Quiet()}
    for module in (extension, project):
        monkeypatch.setattr(module, "extensions", lambda: found)


@pytest.fixture
def folder(tmp_path: Path) -> Callable[[str], Path]:
    def make(text: str) -> Path:
        (tmp_path / "plc.toml").write_text(TOML + text)
        return tmp_path

    return make


def test_an_extension_reads_its_table(folder: Callable[[str], Path]) -> None:
    assert read_project(folder("[web]\nport = 8080\n")).extensions == {"web": 8080}
    assert read_project(folder("")).extensions == {}


def test_an_extension_that_leaves_a_key_gives_an_error(folder: Callable[[str], Path]) -> None:
    with pytest.raises(ConfigurationError, match=r"web\.prot: unknown key; did you mean port\?"):
        read_project(folder("[web]\nprot = 8080\n"))


def test_a_table_that_nobody_claims_is_an_error(folder: Callable[[str], Path]) -> None:
    with pytest.raises(ConfigurationError, match=r"wep: unknown key; did you mean web\?"):
        read_project(folder("[wep]\nport = 8080\n"))


def test_the_settings_say_whether_an_extension_has_a_service() -> None:
    web = {"web": "service_for_tests"}
    assert services_of({"quiet": 1, "web": 2}) == web
    assert services_of({"quiet": 4321, "web": 2}) == {"quiet": "service_for_tests"} | web


def test_in_process_an_extension_may_have_other_settings() -> None:
    assert extension.in_process({"quiet": 1, "web": 2}, "ip") == {"quiet": 3, "web": 2}


class Careful(Web):
    def check(self, settings: int, controller: Controller) -> list[str]:
        if settings == 99:
            raise ConfigurationError("web.port: 99 is nobody's")
        return [f"web.port: {settings} is low"] if settings < 1024 else []


def test_extensions_that_can_check_are_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    controller: Any = None
    monkeypatch.setattr(extension, "extensions", lambda: {"web": Careful(), "quiet": Quiet()})
    assert check_settings({"web": 80, "quiet": 80}, controller) == ["web.port: 80 is low"]
    assert check_settings({"web": 8080}, controller) == []
    with pytest.raises(ConfigurationError, match=r"web\.port: 99"):
        check_settings({"web": 99}, controller)


def test_what_is_wrong_in_several_tables_is_told_in_one_go(monkeypatch: pytest.MonkeyPatch) -> None:
    controller: Any = None
    found = {"web": Careful(), "more": Careful()}
    monkeypatch.setattr(extension, "extensions", lambda: found)
    monkeypatch.setattr(Careful, "check", refuse)
    with pytest.raises(ConfigurationError) as raised:
        check_settings({"web": 1, "more": 2}, controller)
    assert raised.value.findings == ("1 is wrong", "2 is wrong")


def refuse(_self: Careful, settings: int, _controller: Controller) -> list[str]:
    raise ConfigurationError(f"{settings} is wrong")
