"""The fixture modbus: the project's map as an HMI sees it, in virtual time."""

import pytest

from plcsim.modbus.service.errors import ExceptionCode, ModbusException
from plcsim.modbus.testing.master import Modbus
from plcsim.testing.errors import ControllerFault, PlcTestError
from plcsim.testing.target import open_plc

MAP = """tag,area,offset,bit,type,order,scale,min,max,access
cell.start,co,0,,,,,,,
cell.motor.on,di,0,,,,,,,
cell.count,ir,0,,int32,,,,,
cell.level,hr,0,,float32,CDAB,,-10,10,
cell.initial,hr,2,,,,,,,ro
cell.name,hr,3,,string,,,,,
cell.motor.speed,hr,10,,uint16,,0.1,,,
cell.crash_at,hr,11,,int32,,,,,
cell.delay,hr,13,,int32,,,,,wo
cell.history[1],hr,15,,,,,,,
cell.exits,hr,16,,int32,,,,,
"""


@pytest.fixture
def folder(project):
    with (project / "plc.toml").open("a") as file:
        file.write("[modbus]\nunit_ids = [7]\n")
    (project / "tags.csv").write_text(MAP)
    return project


@pytest.fixture
def plc(folder):
    with open_plc(project=folder) as plc:
        yield plc


@pytest.fixture
def modbus(plc):
    plc.cycles(1)
    return Modbus(plc)


def test_tags_are_read_as_an_hmi_shows_them(plc, modbus):
    plc["cell.level"] = 2.5
    plc["cell.motor.speed"] = 7.0
    plc.cycles(1)
    assert modbus.read("cell.level") == 2.5
    assert modbus.read("CELL.NAME") == "cell"
    assert modbus.read("cell.motor.speed") == pytest.approx(7.0)
    assert modbus.read("cell.count") == plc["cell.count"]
    assert modbus.read("cell.motor.on") is False


def test_reads_take_no_time(plc, modbus):
    before_ns = plc.clock.now_ns()
    for _ in range(10):
        modbus.read("cell.count")
    assert plc.clock.now_ns() == before_ns


@pytest.mark.parametrize(
    ("tag", "value"),
    [("cell.start", True), ("cell.level", -2.5), ("cell.name", "press"), ("cell.history[1]", -3)],
)
def test_a_write_is_answered_after_the_publish_that_shows_it(plc, modbus, tag, value):
    cycles = plc.cycle_count
    modbus.write(tag, value)
    assert plc.cycle_count == cycles + 1
    assert plc[tag] == value
    assert modbus.read(tag) == value


def test_the_program_sees_a_write_in_that_cycle(plc, modbus):
    modbus.write("cell.start", True)
    assert plc["cell.motor.on"] is True
    assert modbus.read("cell.motor.on") is True


def test_registers_and_bits_by_address(plc, modbus):
    assert modbus.read_holding_registers(2, 3) == [7, 0x6365, 0x6C6C]
    modbus.write_registers(15, [65_535])
    assert plc["cell.history[1]"] == -1
    modbus.write_coils(0, [True])
    assert modbus.read_coils(0) == [True]
    assert modbus.read_discrete_inputs(0) == [True]
    assert modbus.read_input_registers(0, 2) == [0, plc["cell.count"]]


def test_what_the_server_refuses_raises_with_its_code(modbus):
    with pytest.raises(ModbusException, match=r"level = 11: ILLEGAL_DATA_VALUE") as refused:
        modbus.write("cell.level", 11)
    assert refused.value.code is ExceptionCode.ILLEGAL_DATA_VALUE
    with pytest.raises(ModbusException, match=r"initial = 1: ILLEGAL_DATA_ADDRESS"):
        modbus.write("cell.initial", 1)
    with pytest.raises(ModbusException, match=r"function 3 at 500: ILLEGAL_DATA_ADDRESS"):
        modbus.read_holding_registers(500)


def test_a_tag_that_the_map_does_not_have_offers_near_ones(modbus):
    with pytest.raises(PlcTestError, match=r"cell.levle is not in the map .* mean cell.level"):
        modbus.read("cell.levle")


def test_any_request_can_be_sent_to_any_unit(modbus):
    assert modbus.request(b"\x08\0\0\x12\x34") == b"\x08\0\0\x12\x34"
    assert modbus.request(b"\x63") == b"\xe3\x01"
    assert modbus.request(b"\x03\0\0\0\1", unit=8) == b"\x83\x0b"
    with pytest.raises(PlcTestError, match="closes the connection: a length of"):
        modbus.request(bytes(300))


def test_before_the_first_cycle_the_server_is_busy(plc):
    with pytest.raises(ModbusException, match=r"SERVER_DEVICE_BUSY \(no cycle has run yet\)"):
        Modbus(plc).read("cell.count")


def test_in_service_the_last_values_are_read_and_every_write_fails(plc, modbus):
    crash_at = plc["cell.count"] + 1
    with pytest.raises(ControllerFault):
        modbus.write("cell.crash_at", crash_at)
    assert modbus.read("cell.crash_at") == crash_at
    with pytest.raises(ModbusException, match="SERVER_DEVICE_FAILURE"):
        modbus.write("cell.start", True)
    plc.restart()
    modbus.write("cell.start", True)
    assert modbus.read("cell.start") is True


def test_after_exit_every_request_fails(plc, modbus):
    plc.stop()
    with pytest.raises(ModbusException, match="SERVER_DEVICE_FAILURE"):
        modbus.read("cell.count")
    plc.restart()


def test_a_force_is_stronger_than_an_operator_and_is_what_he_sees(plc, modbus):
    plc.force("cell.level", 4.0)
    plc.force("cell.motor.on", True)  # the program writes FALSE
    modbus.write("cell.level", 5.0)
    assert plc["cell.level"] == 4.0
    assert modbus.read("cell.level") == 4.0
    assert modbus.read("cell.motor.on") is True


def test_what_must_always_hold_is_looked_at_while_a_write_waits(plc, modbus):
    plc.always(lambda: not plc["cell.motor.on"])
    with pytest.raises(AssertionError, match="after every cycle"):
        modbus.write("cell.start", True)


def test_the_status_block_tells_state_and_cycles(plc, modbus):
    assert modbus.read_input_registers(65010, 3) == [2, 0, 1]
    plc.cycles(4)
    assert modbus.read_input_registers(65011, 2) == [0, 5]


def test_read_only_has_no_functions_that_write(folder):
    file = folder / "plc.toml"
    file.write_text(file.read_text() + "read_only = true\n")
    with open_plc(project=folder) as plc:
        plc.cycles(1)
        with pytest.raises(ModbusException, match="ILLEGAL_FUNCTION"):
            Modbus(plc).write("cell.start", True)


def test_automatic_addresses_leave_no_lock_file(project):
    with (project / "plc.toml").open("a") as file:
        file.write("[modbus]\nauto = true\n")
    with open_plc(project=project) as plc:
        modbus = Modbus(plc)
        plc.cycles(1)
        modbus.write("cell.level", 1.5)
        assert plc["cell.level"] == 1.5
    assert not (project / "tags.lock").exists()


def test_every_interleaving_has_a_server_of_its_own(folder):
    with (folder / "plc.toml").open("a") as file:
        file.write('[task_class.2]\nprograms = [{name = "other", source = "cell"}]\n')
    with open_plc(project=folder) as plc:
        for one in plc.every_interleaving(most=2):
            one.cycles(1)
            Modbus(one).write("cell.start", True)
            assert one["cell.start"] is True
        assert plc["cell.start"] is False


def test_a_project_without_the_table_says_so(project):
    with (
        open_plc(project=project) as plc,
        pytest.raises(PlcTestError, match=r"no table \[modbus\] in its plc.toml"),
    ):
        Modbus(plc)
