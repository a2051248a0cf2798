import pytest

from plcsim.project.automation_studio import mapping
from plcsim.project.automation_studio.mapping import (
    Channel,
    Permanent,
    Pv,
    PvMapLine,
    read_channels,
    read_copies,
    read_permanent,
)

CHANNELS = """VAR_CONFIG
  ::gStart AT %IX."X20 DI.9371".DigitalInput01; (* two
lines; *)
  ::Valve:io[2].open AT %QX."Out".Digital.Output01 INVERSE; // rest
  Cyclic#1.gAxis.speed AT %QW."8I64.00x-1".Speed;
  Cyclic#4.::Task:x AT %ib."In".B;
END_VAR
var_config
  last AT %ID."In".D; END_VAR
"""


def test_channels_with_their_variables_modules_and_lines(write):
    file = write({"IoMap.iom": CHANNELS}) / "IoMap.iom"
    found, findings = read_channels(file)
    assert findings == []
    assert found == [
        Channel(Pv("", "gStart"), "I", "X", "X20 DI.9371", "DigitalInput01", False, f"{file}:2"),
        Channel(Pv("Valve", "io[2].open"), "Q", "X", "Out", "Digital.Output01", True, f"{file}:4"),
        Channel(Pv("", "gAxis.speed", 1), "Q", "W", "8I64.00x-1", "Speed", False, f"{file}:5"),
        Channel(Pv("Task", "x", 4), "I", "B", "In", "B", False, f"{file}:6"),
        Channel(Pv("", "last"), "I", "D", "In", "D", False, f"{file}:9"),
    ]
    assert found[0].name == '%IX."X20 DI.9371".DigitalInput01'
    assert [each.pv.tag for each in found[:2]] == ["gStart", "Valve.io[2].open"]


@pytest.mark.parametrize("encoding", ["utf-16", "cp1252", "utf-8-sig"])
def test_maps_are_read_in_the_encoding_that_they_have(tmp_path, encoding):
    file = tmp_path / "IoMap.iom"
    file.write_bytes(f"(* F\xfcller *) {CHANNELS}".encode(encoding))
    found, findings = read_channels(file)
    assert (len(found), findings) == (5, [])


def test_copies_and_permanent_variables(write):
    folder = write(
        {
            "PvMap.vvm": "VAR_CONFIG\n::A:x.y AT %Q.::gZ;\nCyclic#1.::B:a AT %Q.Cyclic#1.::C:b;\n"
            "END_VAR",
            "Cpu.per": "VAR_CONFIG\n gCount AT %MD16200; (* *)\nEND_VAR",
        }
    )
    copies, findings = read_copies(folder / "PvMap.vvm")
    assert findings == []
    assert copies == [
        PvMapLine(Pv("A", "x.y"), Pv("", "gZ"), f"{folder}/PvMap.vvm:2"),
        PvMapLine(Pv("B", "a", 1), Pv("C", "b", 1), f"{folder}/PvMap.vvm:3"),
    ]
    file = folder / "Cpu.per"
    assert read_permanent(file) == ([Permanent(Pv("", "gCount"), f"{file}:2")], [])


@pytest.mark.parametrize("read", [read_channels, read_copies, read_permanent])
def test_what_is_no_mapping_is_found_with_its_line(write, read):
    found, findings = read(write({"x": "VAR_CONFIG\n\n nonsense;\n a AT %ZZ;\nEND_VAR\n"}) / "x")
    assert found == []
    assert [each.line for each in findings] == [3, 4]


def test_a_file_in_an_old_code_page_is_read(tmp_path):
    (tmp_path / "x").write_bytes(b'a AT %IX."M".K\xe4se; (* gr\xf6\xdfe *)')
    ((channel,), findings) = read_channels(tmp_path / "x")
    assert (channel.channel, findings) == ("Käse", [])


def test_files_that_cannot_be_read(tmp_path, monkeypatch):
    assert read_channels(tmp_path / "gone")[1][0].message == "No such file or directory"
    (tmp_path / "large").write_text(" " * 100)
    monkeypatch.setattr(mapping, "MAX_BYTES", 50)
    assert "larger than" in read_channels(tmp_path / "large")[1][0].message


def test_an_endless_comment_ends_with_the_file(write):
    found, findings = read_channels(write({"x": 'a AT %IX."M".C; (* b AT %IX."M".D;'}) / "x")
    assert (len(found), findings) == (1, [])


@pytest.mark.parametrize("end", ["", "(* END_VAR", " b AT %IX."])
def test_a_map_that_ends_in_the_middle_is_found(write, end):
    file = write({"x": f'VAR_CONFIG\na AT %IX."M".C;\n{end}'}) / "x"
    found, findings = read_channels(file)
    assert len(found) == 1
    assert findings[0].message == "END_VAR is missing: the file ends in the middle"
    assert findings[0].line == (3 if "AT" in end else 2)
