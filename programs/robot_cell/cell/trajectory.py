"""A trajectory in PLC memory, what is wrong with one that comes, and where the arm shall be."""

from itertools import pairwise
from math import isfinite

from crosnode.messages import Message
from st_types import ARRAY, LREAL, UINT, Struct, var

JOINTS = 6
POINTS = 100
NAMES = [f"joint_{number}" for number in range(1, JOINTS + 1)]
FASTEST = 3.0
"""rad/s of a joint."""
FARTHEST = 6.3
"""rad of a joint, both ways."""
NS_PER_S = 1_000_000_000

INVALID_GOAL = -1
INVALID_JOINTS = -2


class Point(Struct):
    """Where the joints shall be, and when."""

    position = var(ARRAY(LREAL, (1, JOINTS)))
    time_s = var(LREAL)


class Trajectory(Struct):
    """All points of a trajectory; the first is where the arm was."""

    count = var(UINT)
    points = var(ARRAY(Point, (0, POINTS)))


def fault_of(trajectory: Message, start: list[float]) -> tuple[int, str]:
    """Return error code and text of a trajectory that the arm cannot follow, (0, "") otherwise."""
    if sorted(trajectory.joint_names) != NAMES:
        return INVALID_JOINTS, f"joints are {', '.join(NAMES)}"
    if not 0 < len(trajectory.points) <= POINTS:
        return INVALID_GOAL, f"1 to {POINTS} points"
    rows = [(0.0, start), *rows_of(trajectory)]
    for (before_s, before), (time_s, position) in pairwise(rows):
        if len(position) != JOINTS or not all(isfinite(each) for each in position):
            return INVALID_GOAL, f"each point has {JOINTS} positions"
        if time_s <= before_s:
            return INVALID_GOAL, "each point is later than the one before"
        steps = [abs(to - at) for at, to in zip(before, position, strict=True)]
        if max(steps) > FASTEST * (time_s - before_s):
            return INVALID_GOAL, f"no joint is faster than {FASTEST} rad/s"
        if max(abs(each) for each in position) > FARTHEST:
            return INVALID_GOAL, f"no joint goes beyond {FARTHEST} rad"
    return 0, ""


def rows_of(trajectory: Message) -> list[tuple[float, list[float]]]:
    """Return time and positions of each point, joints in the arm's order."""
    order = [trajectory.joint_names.index(name) for name in NAMES]
    return [
        (
            point.time_from_start.to_ns() / NS_PER_S,
            [float(point.positions[place]) for place in order if place < len(point.positions)],
        )
        for point in trajectory.points
    ]


def fill(target: Trajectory, trajectory: Message, start: list[float]) -> None:
    """Copy a trajectory into PLC memory, behind where the arm is."""
    rows = [(0.0, start), *rows_of(trajectory)]
    for point, (time_s, position) in zip(target.points, rows, strict=False):
        point.time_s = time_s
        for number, at in enumerate(position, 1):
            point.position[number] = at
    target.count = len(rows)


def position_at(trajectory: Trajectory, time_s: float) -> list[float]:
    """Return where the arm shall be, in a straight line between two points."""
    points = trajectory.points
    for number in range(1, trajectory.count):
        before, after = points[number - 1], points[number]
        if time_s < after.time_s:
            part = (time_s - before.time_s) / (after.time_s - before.time_s)
            return [
                at + part * (to - at)
                for at, to in zip(before.position, after.position, strict=True)
            ]
    return list(points[trajectory.count - 1].position)
