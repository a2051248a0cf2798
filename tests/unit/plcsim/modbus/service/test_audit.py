import json
import os
from pathlib import Path

import pytest

from plcsim.modbus.service import audit
from plcsim.modbus.service.audit import AuditLog
from plcsim.modbus.service.connection import WriteRecord

RECORD = WriteRecord(1, bytes.fromhex("060004002a"), 0)


def test_a_write_is_a_line(tmp_path: Path) -> None:
    file = tmp_path / "deep" / "audit.jsonl"
    with AuditLog(str(file)) as log:
        log.write("10.0.0.7:4711", "operator", RECORD)
        log.write("10.0.0.7:4711", "operator", RECORD._replace(result=3))
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    assert [line["exception"] for line in lines] == [0, 3]
    assert lines[0]["time"].endswith("+00:00")
    del lines[0]["time"]
    assert lines[0] == {
        "peer": "10.0.0.7:4711",
        "role": "operator",
        "unit": 1,
        "function": 6,
        "pdu": "060004002a",
        "exception": 0,
    }


def test_a_full_file_is_kept_and_a_new_one_started(tmp_path: Path) -> None:
    file = tmp_path / "audit.jsonl"
    with AuditLog(str(file), largest=1000) as log:
        for _ in range(50):
            log.write("p", "", RECORD)
    assert file.stat().st_size <= 1000
    assert (tmp_path / "audit.jsonl.1").stat().st_size <= 1000
    assert len(list(tmp_path.iterdir())) == 2


def test_a_later_log_is_appended(tmp_path: Path) -> None:
    file = tmp_path / "audit.jsonl"
    for _ in range(2):
        with AuditLog(str(file)) as log:
            log.write("p", "", RECORD)
    assert len(file.read_text().splitlines()) == 2


def test_without_a_file_nothing_is_written() -> None:
    with AuditLog("") as log:
        log.write("p", "", RECORD)


def test_a_file_that_cannot_be_written_is_named_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "plain").touch()
    with AuditLog(str(tmp_path / "plain" / "audit.jsonl")) as log:
        log.write("p", "", RECORD)
        log.write("p", "", RECORD)
    assert capsys.readouterr().err.count("cannot be written") == 1


def test_a_full_disk_does_not_stop_the_service(capsys: pytest.CaptureFixture[str]) -> None:
    with AuditLog("/dev/full") as log:
        log.write("p", "", RECORD)
        log.write("p", "", RECORD)
    assert capsys.readouterr().err.count("No space left") == 1


def test_after_the_disk_was_full_the_log_goes_on_and_says_what_is_missing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "audit.jsonl"
    file.symlink_to("/dev/full")
    with AuditLog(str(file)) as log:
        for _ in range(3):
            log.write("p", "", RECORD)
        file.unlink()
        for _ in range(2):
            log.write("p", "", RECORD)
        lines = [json.loads(line) for line in file.read_text().splitlines()]
        assert [line.get("lost") for line in lines] == [3, None]
    assert capsys.readouterr().err.count("cannot be written") == 1


def test_half_a_line_is_taken_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "audit.jsonl"
    write = os.write
    with AuditLog(str(file)) as log:
        log.write("p", "", RECORD)
        monkeypatch.setattr(audit.os, "write", lambda fd, data: write(fd, data[:20]))
        log.write("p", "", RECORD)
        monkeypatch.setattr(audit.os, "write", write)
        log.write("p", "", RECORD)
    lines = [json.loads(line) for line in file.read_text().splitlines()]
    assert [line.get("lost") for line in lines] == [None, 1]
