from pathlib import Path

import pytest

from plcsim.cli import declaration_files
from plcsim.cli.declaration_files import find_files, folder_scopes, library_scopes, read_files
from st_types.syntax import source


def test_files_are_found_once_and_in_order(tmp_path: Path) -> None:
    for name in ("b/z.typ", "b/A.FUN", "a.var", "c.txt", "b/c/x.Typ"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    found = find_files([tmp_path / "b", tmp_path, tmp_path / "a.var"])
    names = [str(path.relative_to(tmp_path)) for path in found]
    assert names == ["b/A.FUN", "b/z.typ", "b/c/x.Typ", "a.var"]


def test_failures_do_not_stop_the_reading(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(source, "MAX_SOURCE_BYTES", 1 << 20)
    (tmp_path / "big.typ").write_bytes(bytes((1 << 20) + 1))
    (tmp_path / "ok.typ").write_text("TYPE\nEND_TYPE\n")
    reading = read_files([tmp_path / "big.typ", tmp_path / "none.typ", tmp_path / "ok.typ"])
    assert [file.path for file in reading.files] == [str(tmp_path / "ok.typ")]
    assert reading.lines == 2
    assert "larger than 1 MiB" in reading.failures[0]
    assert reading.failures[1] == f"{tmp_path / 'none.typ'}: error: No such file or directory"


def test_progress_is_for_terminals_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(declaration_files, "MANY_FILES", 1)
    (tmp_path / "a.typ").touch()
    read_files([tmp_path / "a.typ"])
    assert capsys.readouterr().err == ""
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    read_files([tmp_path / "a.typ"])
    assert "reading" in capsys.readouterr().err


def test_the_libraries_are_found_and_see_one_another() -> None:
    libraries = library_scopes()
    assert {"astcp", "standard"} <= {scope.name for scope in libraries}
    assert libraries[0].find_function_block("TON") is not None
    for scope in libraries:
        scope.check()
        assert all(file.diagnostics.records == [] for file in scope.files)


def test_a_folder_sees_those_around_it_and_none_beside_it(tmp_path: Path) -> None:
    for name in ("Global.typ", "P/Types.typ", "P/Q/x.typ", "R/x.typ"):
        (tmp_path / name).parent.mkdir(exist_ok=True, parents=True)
        (tmp_path / name).write_text(f"TYPE T_{Path(name).stem} : TON; END_TYPE")
    scopes = folder_scopes(read_files(find_files([tmp_path])).files, strict=True)
    assert [scope.name for scope in scopes] == [tmp_path.name, "P", "Q", "R"]
    chains = [[scope.name for scope in each.chain][:-2] for each in scopes]
    assert chains[2][:3] == ["Q", "P", tmp_path.name]
    assert chains[3][:2] == ["R", tmp_path.name]
    assert scopes[3].find_type("T_Types") is None
