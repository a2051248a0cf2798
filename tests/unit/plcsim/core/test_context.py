from typing import NamedTuple

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import PAGE, Memory


class Idents(NamedTuple):
    count: int


class Library:
    def __init__(self, context):
        self.context = context
        self.closed = 0

    def close(self):
        self.closed += 1


@pytest.fixture
def context():
    return Context(Memory(2 * PAGE), network="network", settings=[Idents(4)])


def test_a_context_starts_at_release_0_with_what_it_was_given(context):
    assert (context.release_ns, context.network) == (0, "network")
    assert context.settings(Idents) == Idents(4)
    assert Context(context.memory, network=None).settings(Idents) is None


def test_settings_that_are_given_later_take_the_place_of_those_before(context):
    context.give_settings(Idents(5))
    assert context.settings(Idents) == Idents(5)


def test_a_library_is_made_once_by_the_first_block_that_asks(context):
    assert context.libraries() == ()
    library = context.library(Library)
    assert library.context is context
    assert context.library(Library) is library
    other = context.library(list_of_context)
    assert other == [context]
    assert context.libraries() == (library, other)


def list_of_context(context):
    return [context]


def test_contexts_do_not_share_libraries(context):
    other = Context(context.memory, network=None)
    assert other.library(Library) is not context.library(Library)


def test_restart_closes_the_libraries_and_forgets_them(context):
    library = context.library(Library)
    context.library(list_of_context)
    context.restart()
    assert (library.closed, context.libraries()) == (1, ())
    assert context.library(Library) is not library
    context.restart()
    assert library.closed == 1


def test_a_context_has_no_other_attributes(context):
    with pytest.raises(AttributeError):
        context.now_ns = 1


def test_the_date_goes_on_with_the_release_time(context):
    context.release_ns = 5
    context.date_ns = 1_000
    context.release_ns = 15
    assert context.date_ns == 1_010
