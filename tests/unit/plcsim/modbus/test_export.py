import csv
import io
import json
import shutil
import subprocess
import tomllib

import pytest

from plcsim.modbus.export import FORMATS
from plcsim.modbus.export.entry import ExportEntry, MapExport, extent
from plcsim.modbus.map import MapRow
from plcsim.modbus.map.csv_file import read_rows
from plcsim.modbus.map.point import Area
from plcsim.modbus.map.resolve import resolve

from .plants import FILE, controller

PLC = controller()
TEXT = """tag,area,offset,bit,type,length,order,access,scale,unit,alias,description
p.flag,co,0,,,,,,,,,a | b
p.other,di,9999,,,,,,,,,
p.number,ir,65535,,,,,,,,,
p.real,hr,0,,,,CDAB,,,m,,level
p.double,hr,2,,int16,,,,0.5,,1,
p.text,hr,10,,,4,,,,,,
p.flag,hr,14,3,,,,,,,1,
p.other,hr,15,,,,,,,,1,
p.vast,hr,200,,,,,ro,,,,
"""
ROWS: list[MapRow] = read_rows(TEXT, FILE)
POINTS = resolve(ROWS, PLC.tags.find, FILE, "ABCD")
EXPORT = MapExport("cell", "127.0.0.1", 1502, list(map(ExportEntry, ROWS, POINTS)))


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_names_every_tag_and_is_the_same_every_time(name: str) -> None:
    text = FORMATS[name](EXPORT)
    assert text == FORMATS[name](EXPORT)
    assert "number" in text


@pytest.mark.parametrize("name", FORMATS)
def test_an_empty_map_is_exported(name: str) -> None:
    assert isinstance(FORMATS[name](MapExport("cell", "::1", 502, [])), str)


def test_all_ways_of_counting_an_address() -> None:
    rows = list(csv.DictReader(io.StringIO(FORMATS["csv"](EXPORT))))
    counted = [
        (r["pdu_offset"], r["one_based"], r["modicon5"], r["modicon6"], r["ignition"]) for r in rows
    ]
    assert counted == [
        ("0", "1", "00001", "000001", "C1"),
        ("9999", "10000", "", "110000", "DI10000"),
        ("65535", "65536", "", "365536", "IR65536"),
        ("0", "1", "40001", "400001", "HRF1"),
        ("2", "3", "40003", "400003", "HR3"),
        ("10", "11", "40011", "400011", "HRS11:8"),
        ("14", "15", "40015", "400015", "HR15.3"),
        ("15", "16", "40016", "400016", "HR16"),
        ("200", "201", "40201", "400201", "HRUI_64201"),
    ]


def test_json_has_the_same_tags() -> None:
    value = json.loads(FORMATS["json"](EXPORT))
    assert (value["schema"], value["port"]) == ("plcsim-tags/1", 1502)
    assert [tag["tag"] for tag in value["tags"]] == [row.tag for row in ROWS]


def test_a_bar_does_not_break_the_table() -> None:
    lines = FORMATS["markdown"](EXPORT).splitlines()
    assert {line.count("|") for line in lines} == {9}


def test_blocks_are_what_one_request_can_read() -> None:
    blocks = EXPORT.blocks(Area.HOLDING_REGISTERS)
    assert [extent(block) for block in blocks] == [(0, 16), (200, 4)]


def test_telegraf_reads_toml_with_a_request_for_each_order() -> None:
    (modbus,) = tomllib.loads(FORMATS["telegraf"](EXPORT))["inputs"]["modbus"]
    requests = {(r["register"], r["byte_order"]): r["fields"] for r in modbus["request"]}
    assert set(requests) == {
        ("coil", "ABCD"), ("discrete", "ABCD"), ("input", "ABCD"), ("holding", "ABCD"),
        ("holding", "CDAB"),
    }  # fmt: skip
    fields = {f["name"]: f for f in requests["holding", "ABCD"]}
    assert fields["p_double_hr2"]["scale"] == 0.5
    assert (fields["p_flag_hr14"]["type"], fields["p_flag_hr14"]["bit"]) == ("BIT", 3)
    assert (fields["p_text"]["type"], fields["p_text"]["length"]) == ("STRING", 4)


def test_modpoll_polls_each_area_and_order() -> None:
    rows = list(csv.reader(io.StringIO(FORMATS["modpoll"](EXPORT))))
    assert rows[0] == ["device", "cell", "1"]
    assert ["poll", "holding_register", "0", "2", "BE_LE"] in rows
    assert ["poll", "holding_register", "2", "202", "BE_BE"] in rows
    assert ["ref", "p_text", "10", "string8", "rw", "", "1.0"] in rows
    assert ["ref", "co0_to_0", "0", "bool8", "rw"] in rows


def test_kepware_and_ignition_know_strings_and_bits() -> None:
    rows = {r["Tag Name"]: r for r in csv.DictReader(io.StringIO(FORMATS["kepware"](EXPORT)))}
    assert rows["p_text"]["Address"] == "400011.8H"
    assert rows["p_flag_hr14"]["Address"] == "400015.03"
    assert rows["p_double_hr2"]["Scaled High"] == "500.0"
    assert rows["p_vast"]["Client Access"] == "RO"
    tags = {tag["name"]: tag for tag in json.loads(FORMATS["ignition"](EXPORT))["tags"]}
    assert tags["p_real"]["opcItemPath"] == "ns=1;s=[cell]HRF1"
    assert tags["p_vast"]["readOnly"] is True


def test_fuxa_gets_one_based_addresses_and_its_own_types() -> None:
    (device,) = json.loads(FORMATS["fuxa"](EXPORT)).values()
    tags = {tag["name"]: tag for tag in device["tags"].values()}
    assert tags["p_real"]["type"] == "Float32MLE"
    assert (tags["p_flag"]["memaddress"], tags["p_flag"]["address"]) == ("000000", "1")
    assert tags["p_double_hr2"]["scale"]["scaledHigh"] == 500.0
    assert "p_text" not in tags


def test_node_red_wires_each_block_to_a_function_that_names_its_values() -> None:
    nodes = {node["id"]: node for node in json.loads(FORMATS["nodered"](EXPORT))}
    reads = [node for node in nodes.values() if node["type"] == "modbus-read"]
    assert sorted((r["dataType"], r["adr"], r["quantity"]) for r in reads) == [
        ("Coil", "0", "1"),
        ("HoldingRegister", "0", "16"),
        ("HoldingRegister", "200", "4"),
        ("Input", "9999", "1"),
        ("InputRegister", "65535", "1"),
    ]
    for read in reads:
        assert nodes[read["wires"][0][0]]["type"] == "function"


NODE = shutil.which("node")


@pytest.mark.skipif(NODE is None, reason="node is not installed")
def test_the_function_of_node_red_decodes_what_the_server_sends() -> None:
    nodes = json.loads(FORMATS["nodered"](EXPORT))
    function = next(n["func"] for n in nodes if n["type"] == "function" and '"p_text"' in n["func"])
    registers = [0x0000, 0x3FC0, 0x0007] + [0] * 7 + [0x6865, 0x6C6C, 0x6F00, 0, 8, 1]
    script = (
        f"const f = new Function('msg', {json.dumps(function)});"
        f"console.log(JSON.stringify(f({{payload: {registers}}}).payload))"
    )
    assert NODE is not None
    done = subprocess.run([NODE, "-e", script], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == {
        "p_real": 1.5,
        "p_double_hr2": 3.5,
        "p_text": "hello",
        "p_flag_hr14": True,
        "p_other_hr15": True,
    }
