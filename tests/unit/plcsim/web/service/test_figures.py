from ..site import Socket


def test_task_classes_are_told_while_a_browser_looks(world):
    async def act():
        async with Socket(world) as socket:
            await socket.ask("follow", topics=["classes"])
            while True:
                told = await socket.pushed("classes")
                if len(told["histograms"]) == 5 and told["cycles"]:
                    return told

    told = world.do(act)
    assert {(each["of"], each["name"]) for each in told["histograms"]} == {
        ("lateness", "1"), ("execution", "1"), ("response", "1"), ("controller", "1"),
        ("program", "p"),
    }  # fmt: skip
    response = next(each for each in told["histograms"] if each["of"] == "response")
    assert sum(count for _, _, count in response["bars"]) == response["entries"] > 0
    last = told["cycles"][-1]
    assert [run[0] for run in last["runs"]] == ["p"]
    assert last["release_ns"] <= last["start_ns"] <= last["end_ns"]
    assert len(told["cycles"]) <= 5  # of four cycle times
    assert told["violations"] == []
    world.plc.run(cycles=2)
    assert world.plc.scan.run_follower is None
    assert len(world.plc.scan.idlers) == 1


def test_who_turns_to_another_page_does_not_look(world):
    async def act():
        async with Socket(world) as first, Socket(world) as second:
            await first.ask("follow", topics=["classes"])
            await second.ask("follow", topics=["classes"])
            await first.ask("follow", topics=["logbook"])
            await second.pushed("classes")
            assert world.hub._followers == 1
            entries = (await first.pushed("logbook"))["entries"]
            assert entries[0]["text"] == "RUN: all INIT units have run"

    world.do(act)
    assert world.hub._followers == 0
