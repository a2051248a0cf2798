from pathlib import Path

import pytest

from plcsim.modbus.extension import EXTENSION, ModbusProject
from plcsim.modbus.map import TagMapError
from plcsim.modbus.map.automatic import LOCK_FILE
from plcsim.modbus.map.load import load_map
from plcsim.modbus.settings import ModbusSettings

from ..plants import controller

PLC = controller()


def test_a_file_is_the_whole_map(tmp_path: Path) -> None:
    file = tmp_path / "tags.csv"
    file.write_text("tag,area,offset\np.number,hr,3\n")
    made = load_map(ModbusSettings(tags=str(file)), tmp_path, PLC.tags, PLC.areas)
    assert [point.tag for point in made.points] == ["p.number"]
    assert made.is_locked


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    file = tmp_path / "tags.csv"
    for data, error in ((b"\x81", "cannot be read"), (b"\xff\xfet\0", "is UTF-16; save it as")):
        file.write_bytes(data)
        with pytest.raises(TagMapError, match=rf"tags\.csv: {error}"):
            load_map(ModbusSettings(tags=str(file)), tmp_path, PLC.tags, PLC.areas)
    file.unlink()
    with pytest.raises(TagMapError, match=r"tags\.csv: cannot be read"):
        load_map(ModbusSettings(tags=str(file)), tmp_path, PLC.tags, PLC.areas)


def test_automatic_addresses_come_behind_those_of_the_file(tmp_path: Path) -> None:
    file = tmp_path / "tags.csv"
    file.write_text("tag,area,offset\np.number,hr,30\n")
    settings = ModbusSettings(tags=str(file), auto=True)
    made = load_map(settings, tmp_path, PLC.tags, PLC.areas)
    assert not made.is_locked
    assert not (tmp_path / LOCK_FILE).exists()
    others = [p for p in made.points if p.area == "hr" and p.tag != "p.number"]
    assert min(p.offset for p in others) == 31


def test_the_extension_locks_new_addresses_and_hands_the_map_over(tmp_path: Path) -> None:
    plc = controller()
    project = ModbusProject(ModbusSettings(auto=True), tmp_path)
    attachment = EXTENSION.attach(project, plc)
    assert (tmp_path / LOCK_FILE).is_file()
    again = EXTENSION.attach(project, plc)
    assert again.for_service == attachment.for_service
    assert attachment.for_service["first_class"] == 1
    assert {tag.path for tag in attachment.exports} == {
        point["tag"] for point in attachment.for_service["points"]
    }
