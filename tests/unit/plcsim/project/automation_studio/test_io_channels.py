from plcsim.project.automation_studio.io_channels import channels_type
from plcsim.project.automation_studio.mapping import Channel, Pv
from st_types import BOOL, DINT, INT, REAL, UDINT, UINT

TYPES = {"level": INT, "speed": REAL, "wide": DINT}


def channel(name, direction, width, variable="x", module="M"):
    return Channel(Pv("", variable), direction, width, module, name, False, 1)


def test_a_channel_has_the_width_of_its_letter_and_the_type_of_its_variable():
    channels = [
        channel("out", "Q", "W", "wide"),
        channel("flag", "I", "X"),
        channel("level", "I", "W", "level"),
        channel("level", "I", "W", "other"),
        channel("speed.Sub", "I", "D", "speed"),
        channel("raw", "I", "D", module="8I64.00x-1"),
    ]
    found = channels_type(channels, lambda pv: TYPES.get(pv.path))
    modules = {member.name: member.data_type for member in found.members}
    assert list(modules) == ["M", "8I64_00x_1"]
    assert [(each.name, each.data_type) for each in modules["M"].members] == [
        ("flag", BOOL),
        ("level", INT),
        ("speed_Sub", REAL),
        ("out", UINT),
    ]
    assert list(modules.values())[1].members[0].data_type is UDINT


def test_no_channels_no_type():
    assert channels_type([], lambda _pv: None) is None
