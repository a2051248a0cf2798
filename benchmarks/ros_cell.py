"""The robot cell beside real ROS 1: is anything lost while masters die and peers stop?

    python benchmarks/ros_cell.py [--seconds 600] [--restart 60] [--json FILE]

programs/robot_cell runs in real time. An actionlib client of rospy drives the arm, goal after goal;
two roscpp listeners follow joints and frames, one of them is stopped for 3 s and continued every
20 s; a real robot_state_publisher turns joints into frames. The master, Debian's rosmaster, is
killed with -9 every ``--restart`` seconds and started again 2 s later.

Exit code 1 where a message of an open connection or a goal was lost, or a cycle time violation was
the program's; one that ended the cell in SERVICE is told, for then goals are lost too. Needs what
tests/interop/ros1/install.sh installs.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import xmlrpc.client
from pathlib import Path
from typing import Any

from _outcome import Target, console, number_above_0, print_machine, print_targets, write_json
from _ports import free_port
from _rospy import PYTHON
from ros_processes import HOST, PLCSIM, PROGRAMS, Project

from crosnode.messages import MessageTypes

HERE = Path(__file__).parent
PUBLISHER = "/usr/lib/robot_state_publisher/robot_state_publisher"
STOP_EVERY_S, STOP_S = 20, 3
MASTER_AWAY_S = 2
SHORTEST_RESTART_S = 5
"""A master that is killed in the middle of this time has come back before the end of it."""
STATES_PER_S = 50
ARM_FRAMES = 6


class Peers:
    """Processes of ROS beside the cell; ``rosmaster`` among them.

    Args:
        folder: for logs.
        port: of the master.
    """

    def __init__(self, folder: Path, port: int) -> None:
        self.uri = f"http://{HOST}:{port}/"
        self._folder = folder
        self._port = port
        self._environment = {
            "ROS_MASTER_URI": self.uri, "ROS_IP": HOST, "PATH": "/usr/bin:/bin",
            "ROS_LOG_DIR": str(folder / "log"), "ROS_HOME": str(folder / "home"),
        }  # fmt: skip
        self.running: dict[str, subprocess.Popen[bytes]] = {}

    def start(self, name: str, *command: str) -> None:
        """Start a process; what it says goes to a log of its name."""
        with (self._folder / f"{name}.log").open("ab") as log:
            self.running[name] = subprocess.Popen(
                command, env=self._environment, stdout=log, stderr=log, start_new_session=True
            )

    def start_master(self) -> None:
        """Start a master, and give it what others ask it for."""
        self.start("master", PYTHON, "/usr/bin/rosmaster", "--core", "-p", str(self._port))
        master = xmlrpc.client.ServerProxy(self.uri)
        urdf = (PROGRAMS / "robot_cell" / "arm.urdf").read_text()
        for _ in range(200):
            with contextlib.suppress(OSError):
                master.setParam("/cell", "/robot_description", urdf)
                return
            time.sleep(0.05)  # rosmaster does not tell when it listens
        raise SystemExit("no rosmaster")

    def kill_master(self) -> None:
        """End the master at once."""
        master = self.running.pop("master")
        os.killpg(master.pid, signal.SIGKILL)
        master.wait()

    def knows_cell(self) -> bool:
        """Whether the master knows who publishes the joint states."""
        try:
            _, _, (publishers, _, _) = xmlrpc.client.ServerProxy(self.uri).getSystemState("/cell")
        except OSError:
            return False
        return any(topic == "/joint_states" for topic, _ in publishers)

    def send(self, name: str, number: int) -> None:
        """Send a signal to a process."""
        self.running[name].send_signal(number)

    def last_line(self, name: str, patience_s: float = 30) -> str:
        """End a process as Ctrl-C does; return the last line that it said."""
        process = self.running.pop(name)
        process.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(patience_s)
        return self.said(name).rpartition("\n")[2]

    def said(self, name: str) -> str:
        """Return the end of what a process has said."""
        return (self._folder / f"{name}.log").read_text(errors="replace").strip()[-2000:]

    def kill_all(self) -> None:
        """Leave nothing behind."""
        for process in self.running.values():
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def start_all(peers: Peers, cell: Project, folder: Path) -> None:
    """Start master, cell and peers, and wait until they talk."""
    peers.start_master()
    cell.change("plc.toml", "port = 1503", f"port = {free_port()}")
    cell.start(peers.uri)
    for _ in range(1000):
        if cell.is_readable():
            break
        if not cell.is_running:
            raise SystemExit(f"the cell ended: {cell.said}")
        time.sleep(0.1)  # Modbus answers when the first cycle is done
    else:
        raise SystemExit(f"the cell did not start in 100 s: {cell.said}")
    listener = compiled_listener(folder)
    peers.start("steady", listener, "steady")
    peers.start("stopped", listener, "stopped")
    peers.start("publisher", PUBLISHER)
    text = folder / "action.txt"
    text.write_text(MessageTypes().message("control_msgs/FollowJointTrajectoryAction").full_text)
    subprocess.run([*PLCSIM, "set", str(cell.folder), "cell.enable", "TRUE"], check=True,
                   stdout=subprocess.DEVNULL)  # fmt: skip
    peers.start("planner", PYTHON, "-W", "ignore", str(HERE / "ros_cell_client.py"), str(text))


def compiled_listener(folder: Path) -> str:
    """Compile the listener."""
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", "roscpp"], capture_output=True, text=True, check=False
    )
    if flags.returncode or not Path(PUBLISHER).exists():
        raise SystemExit("needs roscpp and robot_state_publisher: tests/interop/ros1/install.sh")
    target = str(folder / "listener")
    source = str(HERE / "ros_cell_listener.cpp")
    subprocess.run(["g++", "-O2", "-std=c++17", "-w", source, "-o", target,
                    *flags.stdout.split(), "-pthread"], check=True)  # fmt: skip
    return target


def trouble(peers: Peers, seconds: int, restart_s: int) -> int:
    """Kill and restart the master, stop and continue a peer; return how often the master died.

    Each restart is printed with the seconds that it took until the master knew the cell again.
    """
    deaths, stops, restarted = 0, 0, None
    for second in range(seconds):
        if restarted is not None and peers.knows_cell():
            console.print(f"second {second}: the cell is registered again, {second - restarted} s "
                          f"after the master was started")  # fmt: skip
            restarted = None
        if second % restart_s == restart_s // 2:
            peers.kill_master()
            deaths += 1
            console.print(f"second {second}: master killed with -9, the {deaths}. time")
        elif "master" not in peers.running and second % restart_s == restart_s // 2 + MASTER_AWAY_S:
            peers.start_master()
            restarted = second
            console.print(f"second {second}: master started again")
        if second % STOP_EVERY_S == 5:
            peers.send("stopped", signal.SIGSTOP)
            stops += 1
        elif second % STOP_EVERY_S == 5 + STOP_S:
            peers.send("stopped", signal.SIGCONT)
        time.sleep(1)  # what happens at which second is the measurement
    peers.send("stopped", signal.SIGCONT)
    console.print(f"listener 'stopped' was stopped for {STOP_S} s and continued, {stops} times")
    return deaths


def measure(seconds: int, restart_s: int) -> dict[str, Any]:
    """Run the cell; return what became of everything."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        peers, cell = Peers(folder, free_port()), Project("robot_cell", folder)
        try:
            start_all(peers, cell, folder)
            deaths = trouble(peers, seconds, restart_s)
            planner = json.loads(peers.last_line("planner"))
            heard = {each: [int(word) for word in peers.last_line(each).split()]
                     for each in ("steady", "stopped")}  # fmt: skip
            refused = cell.tag("cell.refused")
        finally:
            peers.kill_all()
            cell.stop()
        said = {"planner": peers.said("planner"), "cell": cell.said}
        return {"deaths": deaths, "planner": planner, "heard": heard, "refused": refused,
                "said": said, "report": cell.report()}  # fmt: skip


def found_targets(found: dict[str, Any], seconds: int) -> list[Target]:
    planner, report = found["planner"], found["report"]
    succeeded = planner["ended"].get("SUCCEEDED", 0)
    steady = found["heard"]["steady"]
    violations = report["task_classes"][0]["violations"]
    return [
        *(Target(f"lost on the open connection of {name!r}", each[1], 0, "messages")
          for name, each in found["heard"].items()),
        Target("goals without success", planner["sent"] - succeeded, 0, "goals"),
        Target("goals", succeeded, seconds // 3, "goals", at_least=True),
        Target("joint states heard", steady[0] / seconds, STATES_PER_S * 0.9, "/s", at_least=True),
        Target("frames of the arm heard", steady[3] / seconds, STATES_PER_S * ARM_FRAMES * 0.5,
               "/s", at_least=True),
        Target("violations by the program", violations["program"], 0, "violations"),
    ]  # fmt: skip


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=number_above_0, default=600)
    parser.add_argument("--restart", type=number_above_0, default=60)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    if options.restart < SHORTEST_RESTART_S:
        parser.error(f"--restart: at least {SHORTEST_RESTART_S} seconds")
    hosts = [print_machine("before")]
    found = measure(options.seconds, options.restart)
    hosts.append(print_machine("after"))
    console.print(f"{found['deaths']} masters killed; goals {found['planner']}")
    for name, (heard, lost, turns, frames) in found["heard"].items():
        console.print(f"{name}: {heard} joint states, {lost} lost, {turns} beginnings, "
                      f"{frames} frames")  # fmt: skip
    scan = found["report"]["task_classes"][0]
    console.print(f"cell: {scan['cycles']} cycles of 4 ms, violations {scan['violations']}, "
                  f"longest own CPU {scan['execution_ns']['maximum'] / 1e6:.2f} ms")  # fmt: skip
    if found["report"]["fault"]:
        console.print(f"the cell ended in {found['report']['state']}: {found['report']['fault']}")
    targets = found_targets(found, options.seconds)
    print_targets(targets)
    write_json(options.json, hosts, targets, found=found)
    return 0 if all(target.met for target in targets) else 1


if __name__ == "__main__":
    sys.exit(main())
