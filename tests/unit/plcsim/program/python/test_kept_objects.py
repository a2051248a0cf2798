"""Objects of Python's that programs share are told of: a restart leaves them as they are."""

from plcsim.project.assembly import load
from plcsim.project.plc_toml import read_project

SHARED = """
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple


class Counter:
    count = 0


@dataclass
class Recipe:
    speed: float


@dataclass(frozen=True)
class Limits:
    low: float


class Point(NamedTuple):
    x: int


class Mode(Enum):
    OFF = 0


TABLE = {1: [2.0]}
LIMITS = Limits(1.0)
ORIGIN = Point(0)
FIRST = Mode.OFF
counter = Counter()
recipe: Recipe = Recipe(1.0)
"""

COUNTER, RECIPE = SHARED.splitlines()[-2:]

MAIN = """
from plcsim import Program
from ..shared import LIMITS, counter, recipe

class Main(Program):
    def cyclic(self):
        counter.count += 1
"""

PLC = '[task_class.1]\nprograms = ["main"]\n'


def test_those_of_a_class_of_the_project_that_can_change_are_told_once(project):
    folder = project({"plc.toml": PLC, "shared.py": SHARED, "main/main.py": MAIN})
    application = load(read_project(folder))
    application.unload()
    lines = [SHARED.splitlines().index(line) + 1 for line in (COUNTER, RECIPE)]
    assert [text.partition(": it is")[0] for text in application.warnings] == [
        f"{folder}/shared.py:{lines[0]}: warning: counter is an object of Python's",
        f"{folder}/shared.py:{lines[1]}: warning: recipe is an object of Python's",
    ]


def test_a_project_without_any_is_told_nothing(project):
    main = MAIN.replace("..shared import LIMITS, counter, recipe", "math import pi").replace(
        "counter.count += 1", "pi"
    )
    application = load(read_project(project({"plc.toml": PLC, "main/main.py": main})))
    application.unload()
    assert application.warnings == ()
