"""The configurations of an Automation Studio project: ``Physical`` and what it lists.

``Physical.pkg`` lists configurations, ``Config.pkg`` the CPU of one, ``Cpu.pkg`` the files of the
CPU: Cpu.sw, IoMap.iom, PvMap.vvm, Cpu.per. Automation Studio 3.0 had Plc.pkg in its place.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from plcsim.library.document import DocumentError, XmlElement, read_document
from plcsim.library.library import CBuild
from plcsim.project.automation_studio.finding import Finding
from plcsim.project.automation_studio.hardware import Hardware, read_hardware
from plcsim.project.automation_studio.software import Software, read_software

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from plcsim.project.automation_studio.names import FileNames

CPU_LISTS: Final = ("Cpu.pkg", "Plc.pkg")
IO_MAP: Final = ".iom"
PV_MAP: Final = ".vvm"
PERMANENT: Final = ".per"


@dataclass(frozen=True)
class Configuration:
    """A configuration.

    Attributes:
        name: of it.
        folder: where it lies.
        hardware: what Hardware.hw says.
        software: what Cpu.sw says.
        files: of the CPU.
        build: how C is compiled.
        software_file: Cpu.sw, or the folder where it should be.
    """

    name: str
    folder: Path
    hardware: Hardware
    software: Software
    files: tuple[Path, ...]
    build: CBuild
    software_file: Path

    def files_of_kind(self, suffix: str) -> list[Path]:
        """Return the files of the CPU with a suffix, in small letters."""
        return [file for file in self.files if file.suffix.lower() == suffix]


class Configurations:
    """The configurations of a project, none of them read yet.

    Args:
        names: of the project's files.

    Attributes:
        findings: what is wrong in the files read so far.
    """

    def __init__(self, names: FileNames) -> None:
        self._names = names
        self.findings: list[Finding] = []
        self.folders = dict(self._folders())

    def _folders(self) -> Iterator[tuple[str, Path]]:
        """Yield the configurations: those that Physical.pkg lists, else the folders there."""
        physical = self._names.below(self._names.folder, "Physical")
        if physical is None:
            place = self._names.folder
            self.findings.append(Finding(place, 0, "there is no folder Physical"))
            return
        file = self._names.below(physical, "Physical.pkg")
        if file is None:
            message = "there is no Physical.pkg: every folder here is taken for a configuration"
            self.findings.append(Finding(physical, 0, message, "Physical.pkg"))
            names = sorted(self._names.in_folder(physical).values())
            yield from ((name, physical / name) for name in names if (physical / name).is_dir())
            return
        for element in self._objects(file, "Configuration"):
            found = self._found(file, physical, element)
            if found is not None:
                yield element.text.strip(), found

    def _document(self, file: Path) -> XmlElement | None:
        try:
            return read_document(file)
        except DocumentError as err:
            self.findings.append(Finding(file, err.line, str(err)))
            return None

    def _objects(self, file: Path, kind: str) -> list[XmlElement]:
        root = self._document(file)
        objects = [] if root is None else root.all("Object", kind)
        return [each for each in objects if each.tag == kind or each.get("Type") == kind]

    def _found(self, file: Path, folder: Path, element: XmlElement) -> Path | None:
        name = element.text.strip() or element.get("Name").strip()
        if element.is_true("Reference"):
            found = self._names.referenced(folder, name)
        else:
            found = self._names.below(folder, name)
        if found is None:
            kind = element.get("Type") or element.tag
            message = f"{kind} {name} is listed and not there"
            self.findings.append(Finding(file, element.line, message, name))
        return found

    def active(self) -> str | None:
        """Return the configuration that was active when the project was saved last."""
        file = self._names.below(self._names.folder, "LastUser.set")
        if file is None:
            return None
        try:
            root = read_document(file)
        except DocumentError as err:  # a warning: it holds no part of the project
            message = f"it does not tell which configuration is active: {err}"
            self.findings.append(Finding(file, err.line, message, "LastUser"))
            return None
        for element in root.all("ConfigurationManager"):
            name = element.get("ActiveConfigurationName")
            if name in self.folders:
                return name
        return None

    def preferred(self) -> str | None:
        """Return the configuration that runs where nobody names one, None if there is none.

        That is the active one, else the one with the most tasks of those made for simulation; of
        these, one that runs something. Else it is the first of those with the most tasks.
        """
        active = self.active()
        order = [] if active is None else [active]
        made_for_it = [name for name in self.folders if self._is_simulation(name)]
        order += sorted(made_for_it, key=self._task_count, reverse=True)
        chosen = next((name for name in order if self._task_count(name)), None)
        chosen = chosen or max([*order, *self.folders], key=self._task_count, default=None)
        if active not in (None, chosen):
            self.findings += self._tasks_of(active)[1]
        return chosen

    def _task_count(self, name: str) -> int:
        return len(self._tasks_of(name)[0].tasks)

    def _tasks_of(self, name: str) -> tuple[Software, list[Finding]]:
        """Return what Cpu.sw of a configuration says, and why that cannot be read."""
        known = len(self.findings)
        folder = self.folders[name]
        file = self._software_file(self._cpu(self._cpu_folder(folder))[1])
        del self.findings[known:]  # they are told when the configuration is read
        if file is not None:
            return read_software(file)
        return Software(), [
            Finding(folder, 0, "the active configuration has no Cpu.sw, and so no task", name)
        ]

    def _is_simulation(self, name: str) -> bool:
        file = self._hardware_file(self.folders[name])
        return file is not None and read_hardware(file)[0].is_simulation

    def read(self, name: str) -> Configuration:
        """Read a configuration, as far as it can be read."""
        folder = self.folders[name]
        hardware, findings = Hardware(), [Finding(folder, 0, "there is no Hardware.hw")]
        hardware_file = self._hardware_file(folder)
        if hardware_file is not None:
            hardware, findings = read_hardware(hardware_file)
        self.findings += findings
        cpu = self._cpu_folder(folder)
        build, files = self._cpu(cpu)
        software_file = self._software_file(files) or cpu
        software = self._software(software_file)
        return Configuration(name, folder, hardware, software, tuple(files), build, software_file)

    def _hardware_file(self, folder: Path) -> Path | None:
        """Return Hardware.hw; Config.pkg may refer to that of another configuration."""
        found = self._names.below(folder, "Hardware.hw")
        listed = self._names.below(folder, "Config.pkg")
        if found is None and listed is not None:
            for element in self._objects(listed, "File"):
                if element.text.strip().lower().endswith(".hw"):
                    return self._found(listed, folder, element)
        return found

    def _software_file(self, files: list[Path]) -> Path | None:
        return next((file for file in files if file.suffix.lower() == ".sw"), None)

    def _software(self, file: Path) -> Software:
        if file.suffix.lower() != ".sw":
            self.findings.append(Finding(file, 0, "there is no Cpu.sw"))
            return Software()
        software, findings = read_software(file)
        self.findings += findings
        return software

    def _cpu_folder(self, folder: Path) -> Path:
        """Return the folder of the CPU: what Config.pkg lists, else the one that has a Cpu.sw."""
        file = self._names.below(folder, "Config.pkg")
        if file is not None:
            for element in self._objects(file, "Cpu"):
                found = self._found(file, folder, element)
                if found is not None:
                    return found if found.is_dir() else found.parent
        candidates = [folder, *(folder / n for n in sorted(self._names.in_folder(folder).values()))]
        lists = [name.lower() for name in (*CPU_LISTS, "Cpu.sw")]
        for candidate in candidates:
            if any(name in self._names.in_folder(candidate) for name in lists):
                return candidate
        return folder

    def _cpu(self, folder: Path) -> tuple[CBuild, list[Path]]:
        """Return how C is compiled, and the files of the CPU."""
        names = self._names.in_folder(folder)
        present = [folder / name for name in sorted(names.values())]
        found = next((names[n.lower()] for n in CPU_LISTS if n.lower() in names), None)
        root = self._document(folder / found) if found else None
        if found is None or root is None:
            return CBuild(), present
        files = [e for e in root.all("Object") if e.get("Type") == "File"]
        listed = [self._found(folder / found, folder, element) for element in files]
        return self._build(root), [file for file in listed if file is not None] or present

    def _build(self, root: XmlElement) -> CBuild:
        build = next(root.all("Build"), XmlElement("Build", {}, 0))
        texts = [each.strip() for each in build.get("AnsicIncludeDirectories").split(",")]
        top = self._names.folder
        found = [self._names.referenced(top, text) for text in texts if text]
        return CBuild(
            build.get("GccVersion"),
            tuple(each for each in found if each is not None),
            build.get("AnsicAdditionalBuildOptions"),
        )
