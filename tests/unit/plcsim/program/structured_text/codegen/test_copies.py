import pytest

from plcsim.program.structured_text.codegen import copies as copies_module
from plcsim.program.structured_text.codegen.copies import MOST_COPIES, Copies, join
from plcsim.program.structured_text.codegen.places import THIS, ScalarPlace


def key(number, root=None, width="w32", base=1):
    return ScalarPlace(number + 1 if root is None else root, base, number * 4, width)


@pytest.fixture
def copies():
    numbers = iter(range(100_000))
    return Copies(lambda _width: next(numbers), this=False)


def test_a_variable_keeps_its_local(copies):
    local = copies.note(key(0))
    assert copies.local_of(key(0)) == local
    copies.forget_roots({1})
    assert copies.local_of(key(0)) is None
    assert copies.note(key(0)) == local != copies.note(key(1))


def test_the_oldest_copy_makes_room(copies):
    for number in range(MOST_COPIES + 1):
        copies.note(key(number))
    assert copies.local_of(key(0)) is None
    assert copies.local_of(key(1)) is not None
    assert len(copies.known) == MOST_COPIES


def test_what_a_loop_holds_stays_and_takes_no_room(copies):
    copies.note(key(0))
    before = copies.hold([key(0)])
    for number in range(1, MOST_COPIES + 2):
        copies.note(key(number))
    assert copies.local_of(key(0)) is not None
    assert copies.is_held(key(0))
    assert len(copies.known) == MOST_COPIES + 1
    copies.release(before)
    assert not copies.is_held(key(0))


def test_a_store_forgets_what_it_meets(copies):
    whole, part, beside = key(0, 9, "w64"), ScalarPlace(9, 1, 4, "u8"), key(3, 9)
    for one in (whole, part, beside):
        copies.note(one)
    copies.forget_met(part)
    assert set(copies.known) == {part, beside}


def test_variables_of_other_roots_are_not_forgotten(copies):
    copies.note(key(0))
    copies.note(key(1))
    copies.forget_roots({2, 0})
    assert list(copies.known) == [key(0)]


def test_a_block_s_data_may_be_reached_by_an_address():
    copies = Copies(lambda _width: 0, this=True)
    member, global_ = ScalarPlace(4, THIS, 0, "w32"), ScalarPlace(0, 77, 0, "w32")
    for one in (member, global_):
        copies.note(one)
    copies.forget_met(global_)
    assert list(copies.known) == [global_]
    copies.note(member)
    copies.forget_met(member)
    assert list(copies.known) == [member]


def test_where_nothing_leads_nothing_is_noted(copies):
    copies.known = None
    assert copies.note(key(0)) is None
    assert copies.local_of(key(0)) is None
    assert copies.fork() is None
    copies.forget_roots({1})
    copies.forget_met(key(0))


def test_locals_are_not_without_end(copies, monkeypatch):
    monkeypatch.setattr(copies_module, "MOST_LOCALS", 3)
    locals_ = [copies.note(key(number)) for number in range(5)]
    assert locals_ == [0, 1, 2, None, None]
    assert copies.note(key(1)) == 1


def test_a_fork_is_apart(copies):
    copies.note(key(0))
    fork = copies.fork()
    copies.note(key(1))
    assert list(fork) == [key(0)]


def test_where_paths_meet_only_what_both_know_is_known():
    both, one, other = key(0), key(1), key(2)
    assert join({both: 1, one: 2}, {other: 3, both: 1}) == {both: 1}
    assert join(None, {both: 1}) == join({both: 1}, None) == {both: 1}
    assert join(None, None) is None
