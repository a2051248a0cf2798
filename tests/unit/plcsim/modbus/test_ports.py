from pathlib import Path

import pytest

from plcsim.modbus import ports


@pytest.mark.parametrize(("text", "first"), [("1024\n", 1024), ("0\n", 0), ("odd", 1024)])
def test_the_first_port_for_everybody_is_the_hosts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, first: int
) -> None:
    file = tmp_path / "ip_unprivileged_port_start"
    monkeypatch.setattr(ports, "_FIRST", file)
    assert ports.unprivileged_ports() == 1024
    file.write_text(text)
    assert ports.unprivileged_ports() == first


def test_the_remedy_is_a_right_or_another_port() -> None:
    assert "502 needs root or CAP_NET_BIND_SERVICE" in ports.remedy(502)
    assert "port = 1502" in ports.remedy(502)


@pytest.mark.parametrize(
    ("capabilities", "may"),
    [("000001ffffffffff", True), ("0000000000000400", True), ("0000000000000bff", False)],
)
def test_the_right_is_a_capability(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capabilities: str, may: bool
) -> None:
    file = tmp_path / "status"
    file.write_text(f"Name:\tx\nCapPrm:\t0000000000000000\nCapEff:\t{capabilities}\n")
    monkeypatch.setattr(ports, "_STATUS", file)
    assert ports.may_use_privileged_ports() is may
