from plcsim.core.context import Context
from plcsim.core.heap_use import Heaps, HeapUse
from plcsim.core.memory import Memory


def test_each_heap_is_told_as_it_is_now():
    context = Context(Memory(), network=None)
    assert Heaps.of(context).uses() == {}
    use = [HeapUse(100, 0, 0, 0, 0)]
    Heaps.of(context).add("main", lambda: use[-1])
    assert Heaps.of(context).uses() == {"main": (100, 0, 0, 0, 0)}
    use.append(HeapUse(100, 8, 16, 1, 2))
    assert Heaps.of(context).uses()["main"] == HeapUse(
        size=100, used=8, most=16, areas=1, refused=2
    )
