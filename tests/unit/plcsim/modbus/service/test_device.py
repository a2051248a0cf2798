from collections.abc import Sequence

import pytest

from plcsim.modbus.map import Area, IllegalAddress, IllegalValue, Point
from plcsim.modbus.map.changes import TagChange
from plcsim.modbus.map.status_block import FIRST, ControllerStatus
from plcsim.modbus.service.device import Device, Identity, Origin, no_status
from plcsim.modbus.service.errors import ExceptionCode, ModbusException
from plcsim.shared_image import (
    Answer,
    CommandOutcome,
    CommandRefused,
    Directory,
    ImageError,
    ImageNotReady,
    StoreCommand,
    Write,
)
from plcsim.shared_image.command import Command

HR = Area.HOLDING_REGISTERS
POINT = Point("p.a", "hr", 0, 1, -1, "H", "ABCD", "rw", 4096, "H", 2)

ORIGIN = Origin("127.0.0.1:9", "", 1, 6)


class Image:
    """An image that fails as it is told to."""

    directory = Directory("p", 1_000_000, [], [(4096, 2)], {})
    latest = 1

    def __init__(self, error: Exception | None = None) -> None:
        self._error = error
        self.answers: dict[int, Answer] = {}

    def copy(self, start: int, end: int) -> tuple[int, bytes]:
        if self._error:
            raise self._error
        return 1, b"\x34\x12"[start:end]

    def send(self, command: Command) -> int:
        if self._error:
            raise self._error
        self.command = command
        return 7

    def take_answer(self, ticket: int) -> Answer | None:
        return self.answers.pop(ticket, None)


def code_of(device: Device, *, write: bool = False, address: int = 0) -> ExceptionCode:
    def ask() -> object:
        if write:
            return device.write(lambda writes: writes.registers(address, b"\0\1"), ORIGIN)
        return device.read(HR, address, 1)

    with pytest.raises(ModbusException) as caught:
        ask()
    return caught.value.code


class Log:
    """An audit log that remembers."""

    def __init__(self) -> None:
        self.lines: list[tuple[Origin, list[TagChange]]] = []

    def applied(self, origin: Origin, changed: Sequence[TagChange]) -> None:
        self.lines.append((origin, list(changed)))

    def refused(self, origin: Origin, pdu: bytes, exception: int) -> None:
        raise AssertionError("nobody was refused")


def test_a_write_is_logged_when_the_scan_has_applied_it() -> None:
    image, log = Image(), Log()
    device = Device(image, [POINT], audit=log)
    write = device.write(lambda writes: writes.registers(0, b"\0\1"), ORIGIN)
    device.collect()
    assert (write.outcome, log.lines) == (CommandOutcome.WAITING, [])
    image.answers[7] = Answer(
        CommandOutcome.APPLIED, 5, Write((StoreCommand(POINT.address, b"\x09\0"),))
    )
    device.collect()
    device.collect()
    assert write.outcome is CommandOutcome.APPLIED
    assert log.lines == [(ORIGIN, [TagChange("p.a", 1, 9)])]


def test_a_write_that_the_scan_refused_is_not_logged_as_applied() -> None:
    image, log = Image(), Log()
    device = Device(image, [POINT], audit=log)
    write = device.write(lambda writes: writes.registers(0, b"\0\1"), ORIGIN)
    image.answers[7] = Answer(CommandOutcome.NO_SUCH_ADDRESS, 0, Write(()))
    device.collect()
    assert (write.outcome, log.lines) == (CommandOutcome.NO_SUCH_ADDRESS, [])


def test_a_register_is_read() -> None:
    device = Device(Image(), [POINT])
    assert device.read(HR, 0, 1) == b"\x12\x34"


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (ImageNotReady("x"), ExceptionCode.SERVER_DEVICE_BUSY),
        (ImageError("x"), ExceptionCode.SERVER_DEVICE_FAILURE),
    ],
)
def test_an_image_that_cannot_be_read_has_a_code(error: Exception, code: ExceptionCode) -> None:
    assert code_of(Device(Image(error), [POINT])) == code


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (CommandRefused("x"), ExceptionCode.SERVER_DEVICE_BUSY),
        (ImageError("x"), ExceptionCode.SERVER_DEVICE_FAILURE),
        (IllegalAddress("x"), ExceptionCode.ILLEGAL_DATA_ADDRESS),
        (IllegalValue("x"), ExceptionCode.ILLEGAL_DATA_VALUE),
    ],
)
def test_a_command_that_is_refused_has_a_code(error: Exception, code: ExceptionCode) -> None:
    assert code_of(Device(Image(error), [POINT]), write=True) == code


def test_an_address_without_a_tag_has_a_code() -> None:
    device = Device(Image(), [POINT])
    assert code_of(device, address=5) == code_of(device, address=5, write=True) == 2
    with pytest.raises(ModbusException):
        device.check_read(HR, 5, 1)


@pytest.mark.parametrize(("state", "readable"), [(1, False), (2, False), (3, True), (4, False)])
def test_in_service_the_last_cycle_can_be_read_but_not_written(
    state: int, *, readable: bool
) -> None:
    device = Device(Image(), [POINT], status=lambda: ControllerStatus(state))
    device.tick(0)
    device.tick(10_000_000_000)
    assert not device.is_alive
    assert code_of(device, write=True) == ExceptionCode.SERVER_DEVICE_FAILURE
    if readable:
        assert device.read(HR, 0, 1) == b"\x12\x34"
        assert device.read(Area.INPUT_REGISTERS, FIRST + 10, 1) == b"\0\3"
    else:
        assert code_of(device) == ExceptionCode.SERVER_DEVICE_FAILURE


def test_without_a_status_page_the_status_is_empty() -> None:
    device = Device(Image(), [POINT])
    assert device.read(Area.INPUT_REGISTERS, FIRST + 10, 1) == bytes(2)
    assert no_status().cycles == 0


def test_a_name_that_is_not_ascii_or_too_long_still_fits_the_answer() -> None:
    identity = Identity(revision="1.2", project="Förderband " * 9)
    assert identity.server_id.startswith(b"plcsim F?rderband")
    assert all(len(value) <= 32 for value in identity.objects.values())
    assert identity.objects[2] == b"1.2"
