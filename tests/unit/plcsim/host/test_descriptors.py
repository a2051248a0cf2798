"""How many descriptors a process may have."""

import resource
import subprocess
import sys

import pytest

LIMITS = "import resource; from plcsim.host import descriptors; {}; print(*resource.getrlimit(7))"


def limits_after(call: str, soft: int, hard: int) -> list[int]:
    assert resource.RLIMIT_NOFILE == 7
    done = subprocess.run(
        [sys.executable, "-c", LIMITS.format(call)],
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard)),
        capture_output=True,
        text=True,
        check=True,
    )
    return [int(limit) for limit in done.stdout.split()]


@pytest.mark.parametrize(("wanted", "allowed"), [(50, 64), (100, 100), (1000, 200)])
def test_the_limit_is_raised_as_far_as_the_system_allows(wanted: int, allowed: int) -> None:
    assert limits_after(f"descriptors.allow({wanted})", 64, 200) == [allowed, 200]


def test_room_is_made_within_the_limit() -> None:
    assert limits_after("descriptors.make_room()", 64, 200) == [64, 200]
