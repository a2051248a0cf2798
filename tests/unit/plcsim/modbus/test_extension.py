"""``plcsim check`` of a project with Modbus."""

import subprocess
from pathlib import Path

import pytest

from plcsim.cli.main import main
from plcsim.modbus import extension
from plcsim.modbus.ports import remedy
from plcsim.project.plc_toml import read_project

PROGRAM = """
from plcsim import Program
from st_types import INT, var

class P(Program):
    number = var(INT)
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "p").mkdir()
    (tmp_path / "p" / "main.py").write_text(PROGRAM)
    (tmp_path / "tags.csv").write_text("tag,area,offset\np.number,hr,5\n")
    return with_modbus(tmp_path, "port = 1502")


def with_modbus(project: Path, text: str) -> Path:
    (project / "plc.toml").write_text(f'[task_class.1]\nprograms = ["p"]\n[modbus]\n{text}\n')
    return project


def key_and_certificate(folder: Path, *password: str) -> None:
    command = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt",
               "ec_paramgen_curve:P-256", "-subj", "/CN=plc", "-days", "2",
               "-keyout", str(folder / "key.pem"), "-out", str(folder / "server.pem"),
               *(password or ["-nodes"])]  # fmt: skip
    subprocess.run(command, check=True, capture_output=True)


TLS = '[modbus.tls]\ncertificate = "server.pem"\nkey = "key.pem"\nclients = "clients.pem"'


def test_a_project_that_is_right_has_nothing_more_to_say(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", str(project)]) == 0
    assert "on this host" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "endpoint"),
    [
        ("port = 1502", "127.0.0.1:1502"),
        ('host = "::1"', "[::1]:502"),
        ("port = 0", "127.0.0.1:any free port"),
    ],
)
def test_the_endpoint_is_told(project: Path, text: str, endpoint: str) -> None:
    settings = read_project(with_modbus(project, text)).extensions["modbus"]
    assert extension.EXTENSION.endpoint(settings) == endpoint


def test_the_map_is_checked_as_by_tags_check(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (project / "tags.csv").write_text("tag,area,offset\np.number,hr,5\np.nummer,hr,6\n")
    assert main(["tags", "check", str(project)]) == 1
    expected = capsys.readouterr().err
    assert main(["check", str(project)]) == 1
    assert capsys.readouterr().err == expected
    assert f"{project / 'tags.csv'}:3: p.nummer" in expected


def test_a_check_of_automatic_addresses_writes_no_lock(project: Path) -> None:
    with_modbus(project, "auto = true")
    (project / "tags.csv").unlink()
    assert main(["check", str(project)]) == 0
    assert not (project / "tags.lock").exists()


@pytest.mark.parametrize("may", [False, True])
def test_a_port_that_needs_rights_is_noted(
    project: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, may: bool
) -> None:
    monkeypatch.setattr(extension, "unprivileged_ports", lambda: 1024)
    monkeypatch.setattr(extension, "may_use_privileged_ports", lambda: may)
    assert main(["check", str(with_modbus(project, "port = 1023"))]) == 0
    shown = f"on this host: modbus.port: {remedy(1023)}"
    assert (shown in capsys.readouterr().out) is not may
    for port in (0, 1024):
        assert main(["check", str(with_modbus(project, f"port = {port}"))]) == 0
        assert "modbus.port" not in capsys.readouterr().out


@pytest.mark.parametrize("bad", ["server.pem", "key.pem", "clients.pem"])
def test_a_file_that_holds_nothing_is_named(
    project: Path, capsys: pytest.CaptureFixture[str], bad: str
) -> None:
    key_and_certificate(project)
    (project / "clients.pem").write_bytes((project / "server.pem").read_bytes())
    with_modbus(project, TLS)
    assert main(["check", str(project)]) == 0
    (project / bad).write_text("no certificate\n")
    assert main(["check", str(project)]) == 1
    assert str(project / bad) in capsys.readouterr().err
    (project / bad).unlink()
    assert main(["check", str(project)]) == 1
    assert f"there is no such file, '{project / bad}'" in capsys.readouterr().err


def test_a_key_with_a_password_is_refused_not_asked_for(
    project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    key_and_certificate(project, "-passout", "pass:secret")
    (project / "clients.pem").write_bytes((project / "server.pem").read_bytes())
    assert main(["check", str(with_modbus(project, TLS))]) == 1
    assert "modbus.tls.key: has a password" in capsys.readouterr().err
