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
    # one program with the names of all: ROS' own headers are most of what is compiled
    names = [source.stem for source in sorted((HERE / "peers").glob("*.cpp"))]
    text = [f'#define main {name}_main\n#include "{HERE / "peers" / name}.cpp"\n#undef main\n'
            for name in names]  # fmt: skip
    text += ["#include <cstring>\nint main(int argc, char** argv)\n{\n"]
    text += ["    const char* name = std::strrchr(argv[0], '/') + 1;\n"]
    text += [f'    if (!std::strcmp(name, "{n}")) return {n}_main(argc, argv);\n' for n in names]
    (folder / "peers.cpp").write_text("".join([*text, "    return 1;\n}\n"]))
    subprocess.run(
        ["g++", "-O0", "-std=c++17", "-w", f"-I{folder}", str(folder / "peers.cpp"),
         "-o", str(folder / "peers"), *flags.stdout.split(), "-pthread"],
        check=True,
    )  # fmt: skip
    for name in names:
        (folder / name).hardlink_to(folder / "peers")
    return folder
