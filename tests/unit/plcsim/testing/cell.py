"""Programs under test for the tests of plcsim.testing."""

from enum import IntEnum

from plcsim import Program
from st_types import ARRAY, BOOL, DINT, ENUM, INT, REAL, STRING, TIME, UINT, Struct, var


class Light(IntEnum):
    RED = 0
    GREEN = 1
    YELLOW = 2


class Motor(Struct):
    on = var(BOOL)
    speed = var(REAL)


class Cell(Program):
    """Counts its cycles, follows a start button, walks through a traffic light."""

    count = var(DINT)
    start = var(BOOL)
    motor = var(Motor)
    level = var(REAL)
    light = var(ENUM(Light))
    name = var(STRING(8), "cell")
    delay = var(TIME, 20)
    history = var(ARRAY(INT, (1, 3)))
    initial = var(UINT, 7)
    crash_at = var(DINT)
    exits = var(DINT)

    def cyclic(self) -> None:
        self.count += 1
        if self.count == self.crash_at:
            self.level = 1 / (self.count - self.crash_at)
        self.motor.on = self.start
        if self.motor.on:
            self.motor.speed += 0.5
        self.light = Light((self.count // 4) % 3)

    def exit(self) -> None:
        self.exits += 1
