import resource
from collections.abc import Iterator

import pytest

from plcsim.services.modbus import __main__ as service


@pytest.fixture
def limits() -> Iterator[tuple[int, int]]:
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    yield soft, hard
    resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


def test_there_are_descriptors_for_all_connections_as_far_as_the_host_gives_them(
    limits: tuple[int, int],
) -> None:
    _, hard = limits
    resource.setrlimit(resource.RLIMIT_NOFILE, (256, hard))
    service._allow_descriptors(200)
    assert resource.getrlimit(resource.RLIMIT_NOFILE) == (256, hard)
    service._allow_descriptors(300)
    assert resource.getrlimit(resource.RLIMIT_NOFILE) == (300, hard)
    if hard != resource.RLIM_INFINITY:
        service._allow_descriptors(hard + 1)
        assert resource.getrlimit(resource.RLIMIT_NOFILE) == (hard, hard)
