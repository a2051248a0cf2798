from plcsim.core.traffic import Traffic


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
