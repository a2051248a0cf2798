import pytest

from plcsim.core.memory import FIRST
from plcsim.modbus.service.handler import AccessRights

from ..site import World


@pytest.fixture
def world() -> World:
    return World()


@pytest.mark.parametrize(
    ("asked", "answer"),
    [
        ("01 0000 0003", "010100"),
        ("02 0000 0001", "020100"),
        ("03 0000 0006", "030c" + "00" * 10 + "0007"),
        ("04 0000 0002", "040400000001"),
        ("05 0001 ff00", "050001ff00"),
        ("06 0000 1234", "0600001234"),
        ("0f 0000 0003 01 05", "0f00000003"),
        ("10 0002 0002 04 3fc00000", "1000020002"),
        ("16 0001 ff00 0034", "160001ff000034"),
        ("17 0005 0001 0000 0001 02 0009", "17020007"),
        ("08 0000 1234 5678", "08000012345678"),
        ("2b 0e 04 00", "2b0e04820000010006706c6373696d"),
    ],
)  # fmt: skip
def test_every_function_is_answered(world: World, asked: str, answer: str) -> None:
    assert world.ask(asked) == answer


def test_the_server_id_names_the_product(world: World) -> None:
    assert world.ask("11") == "1107706c6373696dff"


@pytest.mark.parametrize(
    ("asked", "code"),
    [
        ("01 0003 0002", 2), ("02 0001 0001", 2), ("03 00fa 0001", 2), ("03 ffff 0002", 2),
        ("04 0001 0002", 2), ("05 0003 ff00", 2), ("05 0009 ff00", 2), ("06 0005 0001", 2),
        ("06 0002 3fc0", 2), ("06 0003 0000", 2), ("06 0008 0000", 2), ("06 0004 0065", 3),
        ("06 0004 ffff", 3), ("0f 0002 0002 01 03", 2), ("10 0004 0002 04 00010001", 2),
        ("10 0001 0002 04 00010001", 2), ("10 0002 0002 04 7fc00000", 3),
        ("10 0002 0002 04 7f800000", 3), ("16 0002 0000 0000", 2), ("16 0004 0000 0000", 2),
        ("17 0fff 0001 0000 0001 02 0009", 2), ("17 0000 0001 0005 0001 02 0009", 2),
        ("17 0000 0001 0004 0001 02 0065", 3), ("63", 1), ("2b 0e 04 09", 2),
    ],
)  # fmt: skip
def test_what_the_map_does_not_allow_is_refused_and_changes_nothing(
    world: World, asked: str, code: int
) -> None:
    before = world.plc.memory.read(FIRST, 600)
    cycles = world.tag("p.cycles")
    function = int(asked[:2], 16)
    assert world.ask(asked) == f"{function | 0x80:02x}{code:02x}"
    assert world.tag("p.cycles") == cycles
    assert world.plc.memory.read(FIRST, 600) == before


def test_a_write_is_in_the_next_cycle_and_read_back_by_the_next_request(world: World) -> None:
    cycles = world.tag("p.cycles")
    world.ask("06 0000 002a")
    assert world.tag("p.words[1]") == 42
    assert world.tag("p.cycles") == cycles + 1  # type: ignore[operator]  # a UDINT
    assert world.ask("03 0000 0001") == "0302002a"


def test_the_answer_to_a_write_is_the_request_whatever_the_program_makes_of_it(
    world: World,
) -> None:
    assert world.ask("06 0007 0005") == "0600070005"
    assert world.ask("03 0007 0001") == "030203e7"


def test_a_write_of_many_registers_is_whole(world: World) -> None:
    assert world.ask("10 0068 007b f6" + "0102" * 123) == "100068007b"
    assert world.ask("03 0068 007d") == "03fa" + "0102" * 123 + "0000" * 2


def test_a_mask_is_applied_to_what_the_program_left(world: World) -> None:
    world.ask("06 0001 0012")
    assert world.ask("16 0001 00f2 0025") == "16000100f20025"
    assert world.ask("03 0001 0001") == "03020017"


def test_a_bit_of_a_register_is_a_variable(world: World) -> None:
    world.ask("16 0006 fff7 0008")
    assert world.tag("p.coils[4]") is True
    assert world.ask("03 0006 0001") == "03020008"
    world.ask("06 0006 fff7")
    assert world.tag("p.coils[4]") is False


def test_function_23_reads_what_it_has_written(world: World) -> None:
    assert world.ask("17 0000 0002 0000 0002 04 00070008") == "170400070008"


@pytest.mark.parametrize("asked", ["05 0000 ff00", "06 0000 0001", "0f 0000 0001 01 01",
                                   "10 0000 0001 02 0001", "16 0000 0000 0000",
                                   "17 0000 0001 0000 0001 02 0009"])  # fmt: skip
def test_a_peer_that_may_not_write_finds_no_function_that_writes(world: World, asked: str) -> None:
    peer = world.connect(AccessRights(may_write=False))
    assert world.ask(asked, peer) == f"{int(asked[:2], 16) | 0x80:02x}01"
    assert world.ask("03 0000 0001", peer) == "03020000"


def test_a_peer_without_rights_can_only_ask_nothing(world: World) -> None:
    peer = world.connect(AccessRights(may_read=False, may_write=False))
    assert world.ask("03 0000 0001", peer) == "8301"
    assert world.ask("2b 0e 01 00", peer) == "ab01"


def test_strict_holes(world: World) -> None:
    assert world.ask("03 0007 0004") == "0308" + "00" * 8
    assert World(strict_holes=True).ask("03 0007 0004") == "8302"


def test_a_scan_that_stands_still_is_a_device_failure(world: World) -> None:
    world.device.tick(0)
    world.device.tick(10_000_000_000)
    assert world.ask("03 0000 0001") == "8304"
    assert world.ask("06 0000 0001") == "8604"
    assert world.ask("11") == "1107706c6373696d00"
    world.plc.run(cycles=1)
    world.device.tick(10_000_000_001)
    assert world.ask("03 0000 0001") == "03020000"


def test_no_time_passes_for_reads() -> None:
    world = World()
    before_ns = world.clock.now_ns()
    for _ in range(50):
        world.ask("03 0000 0006")
    assert world.clock.now_ns() == before_ns
