"""``Hardware.hw``: the modules of a configuration, and what it sets on its CPU.

Times are in microseconds there. What a file does not say has the value of a new project.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.library.document import DocumentError, read_document
from plcsim.project.automation_studio.finding import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from plcsim.library.document import XmlElement

SIMULATED_CPU: Final = "PC_any"
"""Type of the module that is a simulated CPU."""

US: Final = 1_000

ROOT: Final = "Hardware"

FILE_VERSION: Final = "4.9"
"""Version of files that Automation Studio writes from 4.9 to 6; older ones give none."""


class ClassTimes(NamedTuple):
    """Times of a task class, None where Hardware.hw does not give them."""

    cycle_ns: int | None = None
    tolerance_ns: int | None = None


@dataclass(frozen=True)
class Hardware:
    """What Hardware.hw says.

    Attributes:
        cpu_type: of the module that is the CPU.
        tick_ns: cycle times are multiples of it; None where it does not say.
        classes: times of the task classes by number.
        file_devices: paths by names that FileIO knows.
        is_simulation: whether the configuration is meant to run simulated.
        modules: names of all modules and their types.
    """

    cpu_type: str = ""
    tick_ns: int | None = None
    classes: Mapping[int, ClassTimes] = field(default_factory=dict)
    file_devices: Mapping[str, str] = field(default_factory=dict)
    is_simulation: bool = False
    modules: Mapping[str, str] = field(default_factory=dict)

    def times(self, number: int) -> ClassTimes:
        """Return the times of a task class."""
        return self.classes.get(number, ClassTimes())


def read_hardware(file: Path) -> tuple[Hardware, list[Finding]]:
    """Read Hardware.hw; what is wrong in it is found, and has the value of a new project."""
    try:
        root = read_document(file)
    except DocumentError as err:
        return Hardware(), [Finding(file, err.line, str(err))]
    modules = [each for each in root.children if each.tag == "Module"]
    likely = [*filter(_is_cpu, modules), *filter(_is_named_as_cpu, modules), *modules]
    cpu = next(iter(likely), None)
    types = {module.get("Name"): module.get("Type") for module in modules}
    if cpu is None:
        return Hardware(), [Finding(file, root.line, "there is no module, and so no CPU")]
    values = _Parameters(file, cpu)
    hardware = Hardware(
        cpu.get("Type"),
        values.time_ns("SystemTick"),
        {number: values.times(number) for number in range(1, 9)},
        dict(values.file_devices()),
        values.text("Simulation") == "1" or cpu.get("Type").startswith(SIMULATED_CPU),
        types,
    )
    return hardware, [*_unknown(file, root), *values.findings]


def _unknown(file: Path, root: XmlElement) -> Iterator[Finding]:
    """Yield a warning where the file is of a kind or version that nobody here has seen."""
    if root.tag != ROOT:
        text = f"the root is {root.tag}, and {ROOT} is known: it is read as that"
        yield Finding(file, root.line, text, ROOT)
    if root.file_version not in ("", FILE_VERSION):
        text = f"file version {root.file_version} is not known, {FILE_VERSION} is: read as that"
        yield Finding(file, 1, text, ROOT)


def _is_cpu(module: XmlElement) -> bool:
    """Whether a module is the CPU; old versions name no configuration, but have task classes."""
    ids = {each.get("ID") for each in module.children if each.tag == "Parameter"}
    return bool(ids & {"ConfigurationID", "Cyclic1Duration", "UserRamSize"})


def _is_named_as_cpu(module: XmlElement) -> bool:
    """Whether a module has the type of a CPU: X20CP..., PP..., 5APC..., PC_any."""
    return any(each in module.get("Type").upper() for each in ("CP", "PC", "PP"))


class _Parameters:
    """The parameters of the CPU itself, not those of its connectors."""

    def __init__(self, file: Path, cpu: XmlElement) -> None:
        self._file = file
        self._parameters = {e.get("ID"): e for e in cpu.children if e.tag == "Parameter"}
        self.findings: list[Finding] = []

    def text(self, name: str) -> str:
        element = self._parameters.get(name)
        return "" if element is None else element.get("Value").strip()

    def time_ns(self, name: str) -> int | None:
        """Return a time that the file gives in microseconds; 0 means that it gives none."""
        us = self._number(name)
        return us * US if us else None

    def times(self, number: int) -> ClassTimes:
        tolerance_us = self._number(f"Cyclic{number}Tolerance")
        return ClassTimes(
            self.time_ns(f"Cyclic{number}Duration"),
            None if tolerance_us is None else tolerance_us * US,
        )

    def _number(self, name: str) -> int | None:
        text = self.text(name)
        if not text:
            return None
        if not (text.isdecimal() and text.isascii() and len(text) <= 12):
            line = self._parameters[name].line
            self.findings.append(Finding(self._file, line, f"{name}: {text!r} is no number"))
            return None
        return int(text)

    def file_devices(self) -> Iterator[tuple[str, str]]:
        for key in self._parameters:
            if key.startswith("FileDeviceName"):
                path = self.text(f"FileDevicePath{key.removeprefix('FileDeviceName')}")
                yield self.text(key), path
