"""Types printed as rosmsg show prints them."""

from crosnode.messages import MessageTypes
from crosnode.messages.outline import outline


def test_message() -> None:
    types = MessageTypes()
    types.define("pkg/Inner", "string K = # all of it\ntime[3] t")
    text = "int32 x # why\nuint8  A = 1\nInner[2] two\nHeader header"
    assert outline(types, types.define("pkg/Type", text)) == (
        "uint8 A=1\n"
        "int32 x\n"
        "pkg/Inner[2] two\n"
        "  string K=# all of it\n"
        "  time[3] t\n"
        "std_msgs/Header header\n"
        "  uint32 seq\n"
        "  time stamp\n"
        "  string frame_id"
    )


def test_service() -> None:
    types = MessageTypes()
    assert outline(types, types.service("std_srvs/Empty")) == "---"
