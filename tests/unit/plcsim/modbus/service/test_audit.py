"""The audit log: what was applied, whoever asked; what was refused, apart and bounded."""

import json
import os
from pathlib import Path
from typing import Any

import pytest

from plcsim.access import line_file
from plcsim.modbus.map.changes import TagChange
from plcsim.modbus.service.audit import (
    BURST,
    FILES,
    FILES_OF_REFUSED,
    HOSTS,
    PAUSE_NS,
    AuditLog,
)
from plcsim.modbus.service.device import Origin

ORIGIN = Origin("10.0.0.7:4711", "operator", 1, 6)
CHANGE = TagChange("control.setpoint", 5.5, 5.0)


def lines_of(file: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in file.read_text().splitlines()]


def test_a_write_is_a_line_with_each_tag_its_value_and_the_one_before(tmp_path: Path) -> None:
    file = tmp_path / "deep" / "audit.jsonl"
    with AuditLog(str(file)) as log:
        log.applied(ORIGIN, [CHANGE, TagChange("control.on", False, True)])
    (line,) = lines_of(file)
    assert line.pop("time").endswith("+00:00")
    assert line == {
        "peer": "10.0.0.7:4711",
        "role": "operator",
        "unit": 1,
        "function": 6,
        "tags": [
            {"tag": "control.setpoint", "value": 5.5, "before": 5.0},
            {"tag": "control.on", "value": False, "before": True},
        ],
    }


def test_tags_that_had_the_value_already_are_counted(tmp_path: Path) -> None:
    file = tmp_path / "audit.jsonl"
    with AuditLog(str(file)) as log:
        log.applied(ORIGIN, [CHANGE, *(TagChange(f"p.{n}", 1, 1) for n in range(7))])
        log.applied(ORIGIN, [TagChange("p.a", 1, 1)])
    one, two = lines_of(file)
    assert (len(one["tags"]), one["unchanged"]) == (1, 7)
    assert (two["tags"], two["unchanged"]) == ([], 1)


def test_what_json_does_not_know_is_text(tmp_path: Path) -> None:
    file = tmp_path / "audit.jsonl"
    with AuditLog(str(file)) as log:
        log.applied(ORIGIN, [TagChange("p.real", 0.5, float("nan"))])
    assert lines_of(file)[0]["tags"][0]["before"] == "nan"


def test_a_full_file_is_kept_and_so_are_older_ones(tmp_path: Path) -> None:
    file = tmp_path / "audit.jsonl"
    with AuditLog(str(file), largest=1000) as log:
        for number in range(200):
            log.applied(ORIGIN, [TagChange("p.a", number + 1, number)])
    files = [file, *(tmp_path / f"audit.jsonl.{n}" for n in range(1, FILES))]
    assert set(tmp_path.iterdir()) == set(files)
    assert all(each.stat().st_size <= 1000 for each in files)
    values = [line["tags"][0]["value"] for each in reversed(files) for line in lines_of(each)]
    assert values == list(range(201 - len(values), 201))


def test_refused_writes_stand_apart_with_what_was_asked(tmp_path: Path) -> None:
    file = tmp_path / "audit.jsonl"
    with AuditLog(str(file)) as log:
        log.refused(ORIGIN, bytes.fromhex("060004002a"), 3)
    assert file.read_text() == ""
    (line,) = lines_of(tmp_path / "audit-refused.jsonl")
    assert (line["pdu"], line["exception"], line["peer"]) == ("060004002a", 3, "10.0.0.7:4711")


def test_no_number_of_refused_writes_pushes_out_a_line_of_an_applied_one(tmp_path: Path) -> None:
    now_ns = 0
    file = tmp_path / "audit.jsonl"
    with AuditLog(str(file), largest=1000, now_ns=lambda: now_ns) as log:
        log.applied(ORIGIN, [CHANGE])
        for number in range(5000):
            now_ns += 100_000_000
            log.refused(Origin(f"10.0.0.7:{number}", "", 1, 6), b"\6\0\0\0\1", 3)
        log.applied(ORIGIN, [CHANGE])
    assert len(lines_of(file)) == 2
    assert len(list(tmp_path.iterdir())) == 1 + FILES_OF_REFUSED


def test_of_one_host_only_so_many_are_noted_and_the_others_counted(tmp_path: Path) -> None:
    now_ns = 0
    with AuditLog(str(tmp_path / "a.jsonl"), now_ns=lambda: now_ns) as log:
        for _ in range(BURST + 500):
            log.refused(ORIGIN, b"\6", 3)
        log.refused(ORIGIN._replace(peer="10.0.0.8:1"), b"\6", 3)
        now_ns = 3 * PAUSE_NS
        for _ in range(5):
            log.refused(ORIGIN, b"\6", 3)
    lines = lines_of(tmp_path / "a-refused.jsonl")
    assert [line["peer"] for line in lines].count("10.0.0.8:1") == 1
    assert len(lines) == BURST + 1 + 3
    assert [line["held_back"] for line in lines if "held_back" in line] == [500]


def test_the_hosts_that_are_remembered_are_bounded(tmp_path: Path) -> None:
    with AuditLog(str(tmp_path / "a.jsonl"), largest=1000) as log:
        for number in range(3 * HOSTS):
            log.refused(ORIGIN._replace(peer=f"[fe80::{number:x}]:1"), b"\6", 3)
        assert len(log._hosts) == HOSTS


def test_a_later_log_is_appended(tmp_path: Path) -> None:
    file = tmp_path / "audit.jsonl"
    for _ in range(2):
        with AuditLog(str(file)) as log:
            log.applied(ORIGIN, [CHANGE])
    assert len(lines_of(file)) == 2


def test_without_a_file_nothing_is_written() -> None:
    with AuditLog("") as log:
        log.applied(ORIGIN, [CHANGE])
        log.refused(ORIGIN, b"\6", 3)


def test_a_file_that_cannot_be_written_is_named_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "plain").touch()
    with AuditLog(str(tmp_path / "plain" / "audit.jsonl")) as log:
        log.applied(ORIGIN, [CHANGE])
        log.applied(ORIGIN, [CHANGE])
    assert capsys.readouterr().err.count("cannot be written") == 1


def test_a_full_disk_does_not_stop_the_service(capsys: pytest.CaptureFixture[str]) -> None:
    with AuditLog("/dev/full") as log:
        log.applied(ORIGIN, [CHANGE])
        log.applied(ORIGIN, [CHANGE])
    assert capsys.readouterr().err.count("No space left") == 1


def test_after_the_disk_was_full_the_log_goes_on_and_says_what_is_missing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "audit.jsonl"
    file.symlink_to("/dev/full")
    with AuditLog(str(file)) as log:
        for _ in range(3):
            log.applied(ORIGIN, [CHANGE])
        file.unlink()
        for _ in range(2):
            log.applied(ORIGIN, [CHANGE])
        assert [line.get("lost") for line in lines_of(file)] == [3, None]
    assert capsys.readouterr().err.count("cannot be written") == 1


def test_half_a_line_is_taken_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "audit.jsonl"
    write = os.write
    with AuditLog(str(file)) as log:
        log.applied(ORIGIN, [CHANGE])
        monkeypatch.setattr(line_file.os, "write", lambda fd, data: write(fd, data[:20]))
        log.applied(ORIGIN, [CHANGE])
        monkeypatch.setattr(line_file.os, "write", write)
        log.applied(ORIGIN, [CHANGE])
    assert [line.get("lost") for line in lines_of(file)] == [None, 1]
