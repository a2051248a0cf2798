"""The configuration is read and set."""

import pytest

from plcsim.library.asarcfg import (
    blocks,
    cfgERR_DEVICE_INVALID,
    cfgERR_OPTION_INVALID,
    cfgERR_VALUE_INVALID,
)
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK

KINDS = [
    ("IPAddr", "pIPAddr", "192.168.0.10"),
    ("SubnetMask", "pSubnetMask", "255.255.255.0"),
    ("DefaultGateway", "pGateway", "192.168.0.1"),
    ("BroadcastAddr", "pBroadcastAddr", "192.168.0.255"),
]
ALL = pytest.mark.parametrize(("kind", "pointer", "first"), KINDS)


def get(plc, kind, pointer, device="IF3", size=16):
    place = plc.bytes(bytes(20))
    view = getattr(blocks, f"CfgGet{kind}")
    found = plc.finish(view, pDevice=plc.text(device), **{pointer: place}, Len=size)
    return found.status, plc.string(place)


def set_(plc, kind, pointer, value, device="IF3", **more):
    view = getattr(blocks, f"CfgSet{kind}")
    return plc.finish(view, pDevice=plc.text(device), **{pointer: plc.text(value)}, **more).status


@ALL
def test_addresses_are_read_and_set(plc, kind, pointer, first):
    assert get(plc, kind, pointer) == (ERR_OK, first)
    assert set_(plc, kind, pointer, "10.1.2.3", Option=1) == ERR_OK
    assert get(plc, kind, pointer) == (ERR_OK, "10.1.2.3")
    assert get(plc, kind, pointer, "IF4") == (ERR_OK, first)
    plc.context.restart()
    assert get(plc, kind, pointer) == (ERR_OK, first)


@ALL
def test_wrong_inputs(plc, kind, pointer, first):
    assert set_(plc, kind, pointer, "10.1.2") == cfgERR_VALUE_INVALID
    assert set_(plc, kind, pointer, "10.1.2.3", "") == cfgERR_DEVICE_INVALID
    assert set_(plc, kind, pointer, "10.1.2.3", Option=2) == cfgERR_OPTION_INVALID
    assert get(plc, kind, pointer, "x" * 64)[0] == cfgERR_DEVICE_INVALID
    assert get(plc, kind, pointer, size=8) == (cfgERR_VALUE_INVALID, "")
    view = getattr(blocks, f"CfgGet{kind}")
    assert plc.finish(view, pDevice=plc.text("IF3")).status == cfgERR_VALUE_INVALID
    assert plc.finish(view).status == cfgERR_DEVICE_INVALID
    assert get(plc, kind, pointer) == (ERR_OK, first)


def test_where_an_address_comes_from(plc):
    device = plc.text("IF3")
    assert plc.finish(blocks.CfgGetEthConfigMode, pDevice=device).ConfigMode == 0
    given = {"pDevice": device, "ConfigMode": 1}
    assert plc.finish(blocks.CfgSetEthConfigMode, **given).status == ERR_OK
    assert plc.finish(blocks.CfgGetEthConfigMode, pDevice=device).ConfigMode == 1
    wrong = plc.finish(blocks.CfgSetEthConfigMode, **given | {"ConfigMode": 2})
    assert wrong.status == cfgERR_VALUE_INVALID
    wrong = plc.finish(blocks.CfgSetEthConfigMode, **given, Option=2)
    assert wrong.status == cfgERR_OPTION_INVALID
    for view in blocks.CfgGetEthConfigMode, blocks.CfgSetEthConfigMode:
        assert plc.finish(view).status == cfgERR_DEVICE_INVALID


def test_the_name_of_the_controller(plc):
    place = plc.bytes(bytes(20))
    assert plc.finish(blocks.CfgSetHostName, pHostName=plc.text("cell7")).status == ERR_OK
    assert plc.finish(blocks.CfgGetHostName, pHostName=place, Len=20).status == ERR_OK
    assert plc.string(place) == "cell7"
    assert plc.finish(blocks.CfgSetHostName).status == cfgERR_VALUE_INVALID
    wrong = plc.finish(blocks.CfgSetHostName, pHostName=place, Option=7)
    assert wrong.status == cfgERR_OPTION_INVALID


def test_the_time_zone(plc):
    assert plc.finish(blocks.CfgSetTimeZone, timezoneID=27).status == ERR_OK
    assert plc.finish(blocks.CfgGetTimeZone).timezoneID == 27
    assert plc.finish(blocks.CfgSetTimeZone, option=2).status == cfgERR_OPTION_INVALID


def test_the_mac_address(plc):
    place, device = plc.bytes(b"#" * 7), plc.text("IF3")
    found = plc.call(blocks.CfgGetMacAddr, pDevice=device, pMacAddr=place, Len=6)
    assert found.status == ERR_OK
    assert plc.memory.read(place, 7) == b"\x02\0\0\0\0\x01#"
    short = plc.call(blocks.CfgGetMacAddr, pDevice=device, pMacAddr=place, Len=5)
    assert short.status == cfgERR_VALUE_INVALID
    assert plc.call(blocks.CfgGetMacAddr, pMacAddr=place, Len=6).status == cfgERR_DEVICE_INVALID


@pytest.mark.parametrize("name", [name for name in dir(blocks) if name.startswith("Cfg")])
def test_disabled(plc, name):
    block = plc.new(getattr(blocks, name))
    block(enable=False)
    assert block.status == ERR_FUB_ENABLE_FALSE
