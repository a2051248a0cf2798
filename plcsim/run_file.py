"""Where a running project is found: a small file for each, in a folder of the user's own.

It names the supervisor and the descriptors of its shared memory, which another process of the same
user opens through /proc. A file whose supervisor has died is no run.
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

from plcsim.errors import PlcError


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


def _file(project: Path) -> Path:
    name = hashlib.sha256(os.fsencode(project.resolve())).hexdigest()[:16]
    return _folder() / f"{name}.json"


def announce(project: Path, run: Run) -> None:
    """Write the run file of a project folder; a later run of the same folder replaces it."""
    file = _file(project)
    fresh = file.with_suffix(f".{run.pid}")
    fresh.write_text(json.dumps(run._asdict()), "utf-8")
    fresh.replace(file)


def withdraw(project: Path, run: Run) -> None:
    """Remove the run file, unless another run has replaced it."""
    with contextlib.suppress(PlcError, OSError):
        if find_run(project) == run:
            _file(project).unlink()


def find_run(project: Path) -> Run:
    """Return the run of a project folder.

    Raises:
        PlcError: it is not running.
    """
    try:
        values = json.loads(_file(project).read_text("utf-8"))
        run = Run(values["pid"], values["image_fd"], values["status_fd"])
    except (OSError, ValueError, KeyError, TypeError):
        raise PlcError(f"{project} is not running; start it with plcsim run") from None
    if not run.is_alive:
        raise PlcError(f"{project} is not running any more; start it with plcsim run")
    return run
