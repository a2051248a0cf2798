from crosnode.messages import Time

from .world import MS, OTHER_IP, World


def test_time_is_the_release_moved_to_the_epoch() -> None:
    world = World()
    node = world.node("n", epoch_ns=10**18)
    world.run(7)
    assert node.now_ns == 10**18 + 7 * MS


def test_simulated_time_is_0_until_the_clock_comes_and_then_follows_it() -> None:
    world = World()
    driver = world.node("driver", OTHER_IP)
    driver.set_param("/use_sim_time", True)
    clock = driver.register_publisher("/clock", "rosgraph_msgs/Clock")
    world.run(30)
    node = world.node("n", epoch_ns=10**18)
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
