"""What the service does about clients that misbehave."""

import pytest

pytest.importorskip("asyncua")

from plcsim.opcua.service.server import MOST_UNREAD, cut_off


class Transport:
    def __init__(self, unread):
        self.unread = unread
        self.is_aborted = False

    def get_write_buffer_size(self):
        return self.unread

    def abort(self):
        self.is_aborted = True


def test_a_client_that_reads_nothing_is_cut_off():
    reader, sleeper = Transport(MOST_UNREAD), Transport(MOST_UNREAD + 1)

    cut_off([reader, sleeper])

    assert (reader.is_aborted, sleeper.is_aborted) == (False, True)
