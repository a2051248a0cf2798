"""``plcsim types from-ros`` and ``to-ros``, from their arguments to their files."""

import argparse
from collections.abc import Callable
from pathlib import Path

import pytest

from crosnode.commands.struct_types import register
from plcsim.cli import types
from plcsim.cli.parser import CommandParser
from plcsim.core.errors import PlcError
from st_types.syntax.declarations import parse_text

Run = Callable[..., tuple[int, str, str]]


def parse(*arguments: str) -> argparse.Namespace:
    parser = CommandParser(prog="plcsim types")
    register(parser.add_subparsers(required=True))
    return parser.parse_args(arguments)


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Run:
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)

    def call(*arguments: object) -> tuple[int, str, str]:
        options = parse(*map(str, arguments))
        code = options.func(options)
        return code, *capsys.readouterr()

    return call


@pytest.fixture
def share(tmp_path: Path) -> Path:
    folder = tmp_path / "share" / "cell" / "msg"
    folder.mkdir(parents=True)
    (folder / "State.msg").write_text("Header header\nfloat64[] q\n")
    (folder / "Plain.msg").write_text("int8 x\n")
    return tmp_path / "share"


def test_from_ros_finds_the_common_messages(run: Run) -> None:
    code, out, _ = run("from-ros", "sensor_msgs/JointState", "--array", "6", "--string", "20")
    assert code == 0
    names = [d.name for item in parse_text(out).items for d in item.declarations]
    assert names[:3] == ["ros_time", "std_msgs_Header", "sensor_msgs_JointState"]
    assert "sensor_msgs_JointState_position_MAX : UDINT := 5;" in out


def test_from_ros_writes_files_that_check_and_go_back(
    run: Run, share: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    printed = run("from-ros", "cell/State", "cell/Plain", "--path", share, "-o", out)[1]
    names = ("ros_time.typ", "std_msgs_Header.typ", "std_msgs_Header.var", "cell_State.typ",
             "cell_State.var", "cell_Plain.typ")  # fmt: skip
    assert printed.split() == [str(out / name) for name in names]
    parser = CommandParser()
    types.register(parser.add_subparsers(required=True))
    options = parser.parse_args(["types", "check", "--strict", str(out)])
    assert options.func(options) == 0
    capsys.readouterr()
    assert (
        "# cell/State\nstd_msgs/Header header\nfloat64[] q\n" in run("to-ros", "cell_State", out)[1]
    )


def test_a_second_type_declares_nothing_again_and_changes_stay(
    run: Run, share: Path, tmp_path: Path
) -> None:
    out = tmp_path / "out"
    run("from-ros", "cell/State", "--path", share, "-o", out)
    bounds = out / "std_msgs_Header.var"
    bounds.write_text(bounds.read_text().replace("80", "20"))
    code, printed, told = run("from-ros", "sensor_msgs/Imu", "-o", out)
    assert code == 0
    assert "std_msgs_Header" not in printed
    assert f"{bounds}: differs and stays as it is\n" in told
    assert f"{out / 'ros_time.typ'}: is there already\n" in told
    assert "20" in bounds.read_text()


def test_a_folder_that_is_none(run: Run, share: Path) -> None:
    with pytest.raises(PlcError, match=r"Not a directory|File exists"):
        run("from-ros", "cell/Plain", "--path", share, "-o", share / "cell" / "msg" / "State.msg")
    with pytest.raises(PlcError, match="nowhere: no such folder"):
        run("from-ros", "cell/Plain", "--path", share / "nowhere")


def test_what_has_no_ros_form_is_refused(run: Run, tmp_path: Path) -> None:
    (tmp_path / "A.typ").write_text(
        "TYPE Axis : STRUCT timer : TON; END_STRUCT; E : (a, b); END_TYPE"
    )
    with pytest.raises(PlcError, match="a function block has no ROS form"):
        run("to-ros", "Axis", tmp_path)
    with pytest.raises(PlcError, match="E is no STRUCT"):
        run("to-ros", "E", tmp_path)
    with pytest.raises(PlcError, match="No message, service or action type x/Nothing"):
        run("from-ros", "x/Nothing")
