from ..site import World, frame, frames


def test_no_time_passes_for_reads() -> None:
    world = World()
    before_ns = world.clock.now_ns()
    for _ in range(50):
        world.ask("03 0000 0006")
    assert world.clock.now_ns() == before_ns


def test_a_write_takes_the_cycles_it_needs() -> None:
    world = World()
    cycles = world.tag("p.cycles")
    data = b"".join(frame(bytes.fromhex("06 0000 0001"), i) for i in range(40))
    assert len(frames(world.server.exchange(world.connect(), data))) == 40
    assert world.tag("p.cycles") == cycles + 3  # type: ignore[operator]  # a UDINT; 16 in flight


def test_a_write_to_a_stopped_controller_fails_instead_of_waiting() -> None:
    world = World()
    world.plc.shutdown()
    assert world.ask("06 0000 0001") == "8604"
    world.server.close()
