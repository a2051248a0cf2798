"""Where running projects are found: a small file for each run, in a folder of the user's own.

It names the supervisor and the descriptors of its shared memory, which another process of the same
user opens through /proc. A file whose supervisor has died is no run; whoever looks for runs next
removes it, of whatever project it is.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import stat
import tempfile
from pathlib import Path
from typing import NamedTuple

from plcsim.core.errors import PlcError


class Run(NamedTuple):
    """A running project: the supervisor's process and the descriptors it holds."""

    pid: int
    image_fd: int
    status_fd: int

    @property
    def is_alive(self) -> bool:
        """False once the supervisor has gone."""
        return Path(f"/proc/{self.pid}/fd/{self.image_fd}").exists()

    def open(self, fd: int) -> int:
        """Return a descriptor of our own for one of the supervisor's.

        Raises:
            PlcError: the supervisor has gone.
        """
        try:
            return os.open(f"/proc/{self.pid}/fd/{fd}", os.O_RDWR | os.O_CLOEXEC)
        except OSError as err:
            raise PlcError(f"the run of process {self.pid} cannot be read: {err}") from None


def _folder() -> Path:
    """Return the user's folder of run files, made if need be.

    Raises:
        PlcError: the folder belongs to somebody else, or something else has its name.
    """
    base = os.environ.get("XDG_RUNTIME_DIR") or tempfile.gettempdir()
    folder = Path(base) / f"plcsim-{os.getuid()}"
    folder.mkdir(mode=0o700, exist_ok=True)
    found = folder.lstat()  # in a folder that all may write to, anybody may leave a link
    if found.st_uid != os.getuid() or not stat.S_ISDIR(found.st_mode):
        raise PlcError(f"{folder} belongs to another user or is no folder")
    return folder


def _prefix(project: Path) -> str:
    """Return what the names of all run files of a project folder begin with."""
    return hashlib.sha256(os.fsencode(project.resolve())).hexdigest()[:16]


def _file(project: Path, run: Run) -> Path:
    return _folder() / f"{_prefix(project)}-{run.pid}-{run.image_fd}.json"


def announce(project: Path, run: Run) -> None:
    """Write the run file of a run of a project folder."""
    _remove_dead()
    file = _file(project, run)
    fresh = file.with_suffix(".new")
    fresh.write_text(json.dumps(run._asdict()), "utf-8")
    fresh.replace(file)


def withdraw(project: Path, run: Run) -> None:
    """Remove the run file of a run."""
    with contextlib.suppress(PlcError, OSError):
        _file(project, run).unlink()


def _remove_dead() -> None:
    """Remove the run files of all runs that have died, killed ones and those of a lost host."""
    for file in _folder().glob("*.json"):
        if _read(file) is None:
            with contextlib.suppress(OSError):
                file.unlink()


def _files(project: Path) -> list[Path]:
    """Return the run files of a project folder, the newest first."""
    found = []
    for file in _folder().glob(f"{_prefix(project)}-*.json"):
        with contextlib.suppress(FileNotFoundError):  # a run that ends removes its own
            found.append((file.stat().st_mtime_ns, file))
    return [file for _, file in sorted(found, reverse=True)]


def _read(file: Path) -> Run | None:
    """Return the run of a run file, None where it is damaged or the run has died."""
    try:
        values = json.loads(file.read_text("utf-8"))
        run = Run(values["pid"], values["image_fd"], values["status_fd"])
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return run if run.is_alive else None


def find_runs(project: Path) -> list[Run]:
    """Return the runs of a project folder, the one that was started last first.

    Raises:
        PlcError: it is not running.
    """
    _remove_dead()
    runs = [run for file in _files(project) if (run := _read(file)) is not None]
    if not runs:
        raise PlcError(f"{project} is not running; start it with plcsim run")
    return runs


def find_run(project: Path) -> Run:
    """Return the run of a project folder that was started last.

    Raises:
        PlcError: it is not running.
    """
    return find_runs(project)[0]
