"""What the commands of ``plcsim ros`` print."""

import io
import json
from pathlib import Path

import pytest

from plcsim.cli.main import main

DATA = Path(__file__).parents[3] / "data" / "ros1"


@pytest.fixture(autouse=True)
def _no_ros_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)


def run(*arguments: str) -> int:
    return main(["ros", *arguments])


def test_md5(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("md5", "std_msgs/String", "std_srvs/Trigger", "nav_msgs/GetMapAction") == 0
    assert capsys.readouterr().out == (
        "std_msgs/String 992ce8a1687cec8c8bd883ec73ca41d1\n"
        "std_srvs/Trigger 937c9679a518e3a18d831e57125ea522\n"
        "nav_msgs/GetMapAction e611ad23fbf237c031b7536416dc7cd7\n"
    )


def test_md5_with_paths(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "Ask.srv").write_text("---\ncrosnode_test/HeaderNotFirst x\n", "utf-8")
    paths = ["--path", str(DATA / "packages"), "--path", str(tmp_path)]
    assert run("md5", *paths, "crosnode_test/HeaderNotFirst", "own/Ask") == 0
    first, second = capsys.readouterr().out.splitlines()
    assert first == "crosnode_test/HeaderNotFirst 98a2d52184cf60ad49764577e90008b2"
    assert second.startswith("own/Ask ")


def test_ros_package_path(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"/nowhere:{DATA / 'packages'}")
    assert run("md5", "crosnode_test/HeaderNotFirst") == 0
    assert capsys.readouterr().out.endswith(" 98a2d52184cf60ad49764577e90008b2\n")


def test_md5_goes_on_after_an_unknown_type(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("md5", "std_msgs/None", "std_msgs/Bool") == 1
    out, err = capsys.readouterr()
    assert out == "std_msgs/Bool 8b94c1b53db61fb6aed406028ad6332a\n"
    assert err == "plcsim: No message, service or action type std_msgs/None.\n"


def test_show(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("show", "sensor_msgs/NavSatFix") == 0
    assert capsys.readouterr().out.startswith(
        "uint8 COVARIANCE_TYPE_UNKNOWN=0\n"
        "uint8 COVARIANCE_TYPE_APPROXIMATED=1\n"
        "uint8 COVARIANCE_TYPE_DIAGONAL_KNOWN=2\n"
        "uint8 COVARIANCE_TYPE_KNOWN=3\n"
        "std_msgs/Header header\n"
        "  uint32 seq\n"
        "  time stamp\n"
    )


def test_show_service(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("show", "std_srvs/SetBool") == 0
    assert capsys.readouterr().out == "bool data\n---\nbool success\nstring message\n"


def test_encode_and_decode(capsys: pytest.CaptureFixture[str]) -> None:
    value = '{"data": "é"}'
    assert run("encode", "std_msgs/String", value) == 0
    data = capsys.readouterr().out.strip()
    assert data == "02000000c3a9"
    assert run("decode", "std_msgs/String", data) == 0
    assert json.loads(capsys.readouterr().out) == json.loads(value)


def test_a_string_that_is_not_utf8(capsys: pytest.CaptureFixture[str]) -> None:
    """Any reader of JSON can parse it, and it comes back byte for byte."""
    assert run("decode", "std_msgs/String", "04000000c3a9e922") == 0
    out = capsys.readouterr().out
    assert out == '{"data": "é\\udce9\\""}\n'
    assert out.encode()
    assert run("encode", "std_msgs/String", out) == 0
    assert capsys.readouterr().out == "04000000c3a9e922\n"


def test_half_of_a_service(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("encode", "std_srvs/SetBoolRequest", '{"data": true}') == 0
    assert capsys.readouterr().out == "01\n"
    assert run("encode", "std_srvs/SetBool", "{}") == 1
    assert "std_srvs/SetBoolRequest, std_srvs/SetBoolResponse" in capsys.readouterr().err


def test_standard_input(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO('{"data": 7}\n'))
    assert run("encode", "std_msgs/UInt8", "-") == 0
    monkeypatch.setattr("sys.stdin", io.StringIO("07\n"))
    assert run("decode", "std_msgs/UInt8", "-") == 0
    assert capsys.readouterr().out == '07\n{"data": 7}\n'


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["show", "String"], "'String' is not a type name"),
        (
            ["md5", "--path", "/no/such/folder", "std_msgs/String"],
            "/no/such/folder: no such folder",
        ),
        (["encode", "std_msgs/String", "{"], "std_msgs/String: not JSON: Expecting"),
        (["encode", "std_msgs/String", "[" * 100000], "std_msgs/String: not JSON: "),
        (["encode", "std_msgs/UInt8", '{"data": 256}'], "std_msgs/UInt8.data: 256 is out of range"),
        (["decode", "std_msgs/String", "xy"], "std_msgs/String: not hexadecimal"),
        (["decode", "std_msgs/String", "ffffffff"], "std_msgs/String: "),
    ],
)
def test_errors(arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*arguments) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"plcsim: {message}")


def test_an_action_is_shown_in_its_three_parts(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    folder = tmp_path / "arm" / "action"
    folder.mkdir(parents=True)
    (folder / "Move.action").write_text("float64 to\n---\nbool done\n---\nfloat64 at\n")
    assert run("show", "--path", str(tmp_path), "arm/Move") == 0
    assert capsys.readouterr().out == "float64 to\n---\nbool done\n---\nfloat64 at\n"
    assert run("encode", "--path", str(tmp_path), "arm/Move", "{}") == 1
    assert "arm/Move is no message; name one of arm/MoveGoal, " in capsys.readouterr().err
