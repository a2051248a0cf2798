from __future__ import annotations

import pytest

from plcsim.network.errors import NetworkSetupError
from plcsim.network.wire import Link, is_loopback


@pytest.mark.parametrize(
    "values",
    [
        {"latency_ns": -1},
        {"jitter_ns": -1},
        {"smallest_packet": 0},
        {"smallest_packet": 10, "largest_packet": 9},
    ],
)
def test_a_wrong_link_is_refused(values: dict[str, int]) -> None:
    with pytest.raises(NetworkSetupError, match="Link"):
        Link(**values)


def test_loopback() -> None:
    assert is_loopback("127.0.0.1")
    assert is_loopback("127.9.9.9")
    assert not is_loopback("192.168.127.1")
