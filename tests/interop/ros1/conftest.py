"""Real ROS 1 peers: Debian's packages (install.sh); every test runs against both masters."""

import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from .rig import HERE, PROGRAMS, PYTHON, Ros, ros_system

GENCPP = Path("/usr/lib/gencpp/gen_cpp.py")


@pytest.fixture(scope="session")
def rospy_installed() -> None:
    probe = [PYTHON, "-c", "import rospy, rosmaster, std_srvs.srv, rostopic, rosnode, roswtf"]
    if subprocess.run(probe, capture_output=True, check=False).returncode:
        pytest.skip("Debian's rospy and tools are not installed (tests/interop/ros1/install.sh)")


@pytest.fixture(params=["rosmaster", "plcsim"])
def ros(request: pytest.FixtureRequest, tmp_path: Path, rospy_installed: None) -> Iterator[Ros]:
    with ros_system(request.param, tmp_path) as system:
        yield system


@pytest.fixture(scope="session")
def roscpp(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder with the compiled roscpp peers."""
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", "roscpp", "actionlib"],
        capture_output=True,
        text=True,
        check=False,
    )
    if flags.returncode or not GENCPP.exists():
        pytest.skip("Debian's roscpp is not installed (tests/interop/ros1/install.sh)")
    folder = tmp_path_factory.mktemp("roscpp")
    message = PROGRAMS / "talker" / "packages" / "prova" / "msg" / "hello.msg"
    subprocess.run(
        [PYTHON, str(GENCPP), str(message), f"-Iprova:{message.parent}", "-p", "prova",
         "-o", str(folder / "prova"), "-e", "/usr/share/gencpp"],
        check=True, capture_output=True,
    )  # fmt: skip
    builds = [
        subprocess.Popen(
            ["g++", "-O1", "-std=c++17", "-w", f"-I{folder}", str(source),
             "-o", str(folder / source.stem), *flags.stdout.split(), "-pthread"]
        )
        for source in (HERE / "peers").glob("*.cpp")
    ]  # fmt: skip
    assert [build.wait() for build in builds] == [0] * len(builds)
    return folder
