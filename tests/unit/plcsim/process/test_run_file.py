import json
import os
from pathlib import Path

import pytest

from plcsim.core.errors import PlcError
from plcsim.process.run_file import Run, announce, find_run, find_runs, withdraw


@pytest.fixture(autouse=True)
def runtime_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    return tmp_path / f"plcsim-{os.getuid()}"


def own_run() -> Run:
    fd = os.memfd_create("test")
    os.write(fd, b"shared")
    return Run(os.getpid(), fd, fd)


def test_a_run_is_found_by_its_folder_and_its_memory_opened(tmp_path: Path) -> None:
    run = own_run()
    announce(tmp_path / "project", run)
    found = find_run(tmp_path / "project" / ".." / "project")
    assert found == run
    fd = found.open(found.image_fd)
    assert os.pread(fd, 6, 0) == b"shared"
    os.close(fd)
    withdraw(tmp_path / "project", run)
    os.close(run.image_fd)
    with pytest.raises(PlcError, match="is not running; start it"):
        find_run(tmp_path / "project")


def test_a_run_whose_process_has_died_is_none(tmp_path: Path) -> None:
    announce(tmp_path, Run(2**22 + 1, 5, 6))
    with pytest.raises(PlcError, match="is not running; start it"):
        find_run(tmp_path)
    with pytest.raises(PlcError, match="cannot be read"):
        Run(2**22 + 1, 5, 6).open(5)


def test_runs_of_the_same_folder_are_found_beside_each_other(
    tmp_path: Path, runtime_folder: Path
) -> None:
    first, second = own_run(), own_run()
    for time_ns, run in enumerate((first, second)):
        announce(tmp_path, run)
        (file,) = runtime_folder.glob(f"*-{run.image_fd}.json")
        os.utime(file, ns=(time_ns, time_ns))  # however coarse the clock of the file system is
    announce(tmp_path / "other", own_run())
    assert find_runs(tmp_path) == [second, first]
    withdraw(tmp_path, second)
    assert find_runs(tmp_path) == [first]
    withdraw(tmp_path, second)
    assert find_run(tmp_path) == first


def test_whoever_looks_removes_the_files_of_runs_that_were_killed(
    tmp_path: Path, runtime_folder: Path
) -> None:
    announce(tmp_path, Run(2**22 + 1, 5, 6))
    announce(tmp_path / "other", Run(2**22 + 1, 5, 6))
    announce(tmp_path, own_run())
    assert len(list(runtime_folder.iterdir())) == 1
    announce(tmp_path / "other", Run(2**22 + 1, 5, 6))
    find_run(tmp_path)
    assert len(list(runtime_folder.iterdir())) == 1


@pytest.mark.parametrize("text", ["", "[]", "{}", json.dumps({"pid": 1})])
def test_a_damaged_file_is_no_run(tmp_path: Path, runtime_folder: Path, text: str) -> None:
    announce(tmp_path, own_run())
    next(runtime_folder.glob("*.json")).write_text(text)
    with pytest.raises(PlcError, match="not running"):
        find_run(tmp_path)


def test_the_folder_is_for_its_user_only(tmp_path: Path, runtime_folder: Path) -> None:
    announce(tmp_path, own_run())
    assert runtime_folder.stat().st_mode & 0o777 == 0o700


def test_a_link_in_the_place_of_the_folder_is_not_followed(
    tmp_path: Path, runtime_folder: Path
) -> None:
    home = tmp_path / "home"
    home.mkdir()
    runtime_folder.symlink_to(home)
    with pytest.raises(PlcError, match="is no folder"):
        announce(tmp_path, own_run())
    assert list(home.iterdir()) == []
