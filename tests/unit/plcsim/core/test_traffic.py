from plcsim.core.traffic import Topic, Traffic


def test_a_message_is_handed_to_the_node_that_receives_the_topic() -> None:
    traffic = Traffic()
    taken: list[bytes] = []
    told: list[tuple[str, str, bytes]] = []
    traffic.inlets["/cell", "/in"] = taken.append
    traffic.hand_in_followers.append(lambda *each: told.append(each))

    assert traffic.hand_in("/cell", "/in", b"hello")
    assert not traffic.hand_in("/cell", "/out", b"no")
    assert not traffic.hand_in("/other", "/in", b"no")

    assert taken == [b"hello"]
    assert told == [("/cell", "/in", b"hello")]


def test_equal_topics_have_the_same_number() -> None:
    traffic = Traffic()
    speed = Topic("/speed", "std_msgs/Float64", "0" * 32, "float64 data", "/cell", True, False)

    numbers = [traffic.number_of(t) for t in (speed, speed._replace(name="/b"), Topic(*speed))]

    assert numbers == [0, 1, 0]
    assert [topic.name for topic in traffic.topics] == ["/speed", "/b"]
