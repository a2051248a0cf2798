from crosnode.messages import Time
from crosnode.node import StatusKind
from crosnode.node.ros_time import Epoch

from .world import MS, OTHER_IP, SECOND, World, drain, news


def test_time_is_the_release_moved_to_the_epoch() -> None:
    world = World()
    node = world.node("n", epoch=Epoch(10**18))
    world.run(7)
    assert node.now_ns == 10**18 + 7 * MS


def test_simulated_time_is_0_until_the_clock_comes_and_then_follows_it() -> None:
    world = World()
    driver = world.node("driver", OTHER_IP)
    driver.set_param("/use_sim_time", True)
    clock = driver.register_publisher("/clock", "rosgraph_msgs/Clock")
    world.run(30)
    node = world.node("n", epoch=Epoch(10**18))
    world.until(lambda: "/clock" in node.subscribers and node.subscribers["/clock"].publishers)
    assert node.now_ns == 0
    clock.send(clock.new(clock=Time(5, 250)))
    world.run(5)
    assert node.now_ns == 5_000_000_250
    world.run(100)
    assert node.now_ns == 5_000_000_250


def test_the_question_is_asked_again_when_the_master_was_away() -> None:
    world = World(master=False)
    node = world.node("n")
    world.run(500)
    world.restart_master()
    assert world.master
    world.master.master.set_param("/x", "/use_sim_time", True)
    world.until(lambda: "/clock" in node.subscribers)


def test_a_program_may_listen_to_the_clock_as_well() -> None:
    world = World()
    assert world.master
    world.master.master.set_param("/x", "/use_sim_time", True)
    clock = world.node("driver", OTHER_IP).register_publisher("/clock", "rosgraph_msgs/Clock")
    node = world.node("n")
    own = node.register_subscriber("/clock", "rosgraph_msgs/Clock", queue_size=3)
    world.until(lambda: own.publishers)
    world.run(50)  # the master has said that time is simulated
    for seconds in (7, 3):  # time goes back as well, where a bag is played again
        clock.send(clock.new(clock=Time(seconds, 0)))
        world.run(5)
        assert node.now_ns == seconds * SECOND
    assert [message.clock.secs for message in drain(own.pop)] == [7, 3]
    assert node.now_ns == 3 * SECOND


def test_a_clock_of_another_type_is_told_and_time_stays_0() -> None:
    world = World()
    assert world.master
    world.master.master.set_param("/x", "/use_sim_time", True)
    node = world.node("n", epoch=Epoch(10**18))
    node.register_subscriber("/clock", "std_msgs/Time")
    world.run(300)
    (refused,) = news(node, StatusKind.REGISTRATION_REFUSED)
    assert (refused.name, refused.text) == ("/clock", "/n has /clock already.")
    assert node.now_ns == 0


def test_bytes_that_are_no_time_end_their_connection_only() -> None:
    world = World()
    assert world.master
    world.master.master.set_param("/x", "/use_sim_time", True)
    clock = world.node("driver", OTHER_IP).register_publisher("/clock", "rosgraph_msgs/Clock")
    node = world.node("n")
    world.until(lambda: "/clock" in node.subscribers)
    subscriber = node.subscribers["/clock"]
    world.until(lambda: subscriber.publishers)
    clock.send_raw(b"\1\2\3")
    world.until(lambda: not subscriber.publishers, 50)
    world.until(lambda: subscriber.publishers)
    clock.send(clock.new(clock=Time(9, 0)))
    world.run(5)
    assert node.now_ns == 9 * SECOND


def test_a_wall_clock_that_is_set_is_followed() -> None:
    world, epoch = World(), Epoch(10**18)
    node = world.node("n", epoch=epoch)
    world.run(7)
    epoch.follow(world.now_ns, 2 * 10**18, world.now_ns + 10)
    assert node.now_ns == 2 * 10**18 - 5
    epoch.follow(world.now_ns, 10**18, world.now_ns)  # back again
    assert node.now_ns == 10**18


def test_a_reading_that_was_interrupted_says_nothing() -> None:
    epoch = Epoch(10**18)
    epoch.follow(0, 2 * 10**18, MS)
    assert epoch.ns == 10**18
