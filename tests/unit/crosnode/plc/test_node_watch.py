"""A master that is missing is told once, and the program's own news is not touched."""

from itertools import count

from crosnode.node import CrosNode, StatusKind
from crosnode.plc.node_watch import News, NodeWatch
from plcsim.core.logbook import Severity

from ..node.world import SECOND, World

MISSING = News(
    Severity.WARNING, "/talker: no master at http://192.168.0.1:11311/; trying on"
)  # fmt: skip
FOUND = News(Severity.INFORMATION, "/talker: master at http://192.168.0.1:11311/ found")


class Site:
    """A node in a world, and who watches it."""

    def __init__(self, *, master: bool = False) -> None:
        self.world = World(master=master)
        self.node: CrosNode = self.world.node("talker", clock_ns=count().__next__)
        self.watch = NodeWatch(self.world.context("192.168.0.11"))
        self.watch.add(self.node)

    def told(self, seconds: int) -> list[News]:
        """Run for a time, looking every second."""
        found: list[News] = []
        for _ in range(seconds):
            self.world.run(1_000)
            found += self.watch.look(self.world.now_ns)
        return found


def test_a_missing_master_is_told_once_and_once_when_it_is_found() -> None:
    site = Site()
    assert site.told(3) == []
    assert site.told(6) == [MISSING]
    site.world.restart_master()
    assert site.told(3) == [FOUND]
    site.world.kill_master()
    assert site.told(8) == [MISSING]


def test_a_node_that_others_end_is_told_of() -> None:
    site = Site(master=True)
    site.told(2)
    site.node.shut_down("rosnode kill")
    text = "/talker: ended for good; respawn = true in [ros] brings it back: rosnode kill"
    assert site.told(3) == [News(Severity.WARNING, text)]


def test_the_program_gets_all_news_itself() -> None:
    site = Site()
    site.told(6)
    site.world.restart_master()
    site.told(3)
    kinds = [status.kind for status in iter(site.node.pop_status, None)]
    assert kinds[:2] == [StatusKind.MASTER_LOST, StatusKind.MASTER_FOUND]


def test_a_master_that_is_away_for_a_moment_is_not_worth_a_line() -> None:
    site = Site(master=True)
    assert site.told(2) == []
    site.world.kill_master()
    site.told(2)
    site.world.restart_master()
    assert site.told(5) == []


def test_a_node_that_does_no_steps_or_has_ended_misses_nothing() -> None:
    site = Site()
    site.world.steps.clear()
    assert site.told(10) == []
    site.world.steps.append(site.node.do_events_loop)
    assert site.told(2) == []
    site.node.close()
    assert site.told(10) == []
    assert site.world.now_ns == 22 * SECOND


def test_messages_that_the_program_does_not_take_are_told_of_seldom() -> None:
    site = Site(master=True)
    site.node.register_subscriber("/newest", "std_msgs/String", queue_size=1)
    word = site.node.register_subscriber("/word", "std_msgs/String", queue_size=10)
    other = site.world.node("other", "192.168.0.12")
    publishers = [other.register_publisher(t, "std_msgs/String") for t in ("/newest", "/word")]
    site.world.until(lambda: all(each.subscribers for each in publishers))

    def told(messages: int) -> list[str]:
        for _ in range(messages):
            for each in publishers:
                each.send(each.new())
            site.world.run(2)
        return [text for _, text in site.told(1)]

    assert told(10) == []
    assert told(5) == ["/talker: /word: 5 messages dropped, its queue_size is 10"]
    assert told(44) == []
    assert told(1) == ["/talker: /word: 50 messages dropped, its queue_size is 10"]
    assert word.dropped == 50


def test_idents_that_run_out_are_told_once_in_ten_minutes() -> None:
    site = Site(master=True)
    pool = site.watch._pool
    assert site.told(2) == []
    for _ in range(3):
        pool.shortages += 1
        site.told(1)
    pool.shortages += 1
    site.world.now_ns += 600 * SECOND
    text = "no AsTCP ident is free: all 128 of [library.AsTCP] are in use"
    assert site.told(1) == [News(Severity.WARNING, text)]
    pool.shortages += 1
    assert site.told(1) == []
