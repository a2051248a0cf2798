"""Registers and objects of devices that are not there: what is written is read back."""

import pytest

from plcsim.library.bus.objects import IOAC_PARAMETER
from plcsim.library.runtime import ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE
from st_types import BOOL, INT, UDINT, UINT, USINT
from st_types.types.derived import Member, StructType

NAMES = {"enable": BOOL, "pDeviceName": UDINT, "pChannelName": UDINT}
PLACE = {"enable": BOOL, "pDevice": UDINT, "node": USINT, "index": UINT, "subindex": USINT}
EIGHT = {f"data{index}": USINT for index in range(8)} | {"datalen": USINT}
STATUS = {"status": UINT, "error": UINT, "errorinfo": UDINT}
AT = {"node": 3, "index": 0x6040, "subindex": 1}


@pytest.fixture
def channels(plc):
    """``channels(plc)``: what reads and what writes a channel."""

    def make(plc=plc):
        read = plc.model("AsIOAccRead", NAMES, {"status": UINT, "value": UDINT})
        write = plc.model("AsIOAccWrite", {**NAMES, "value": UDINT}, {"status": UINT})
        return read, write

    return make


def test_a_register_of_a_module_is_read_back(plc, channels):
    read, write = channels()
    device, channel = plc.text("IF3.ST1"), plc.text("CfO_Filter")
    assert read.finish(pDeviceName=device, pChannelName=channel) == 0
    assert read["value"] == 0
    assert write.finish(pDeviceName=device, pChannelName=channel, value=4_000_000_000) == 0
    assert read.finish(pChannelName=plc.text("cfo_filter")) == 0
    assert read["value"] == 4_000_000_000
    assert read.finish(pDeviceName=plc.text("IF3.ST2")) == 0
    assert read["value"] == 0


def test_a_block_is_busy_once_and_disabled_without_enable(plc, channels):
    read, _ = channels()
    assert read(enable=False) == ERR_FUB_ENABLE_FALSE
    found = [read(enable=True, pDeviceName=plc.text("A"), pChannelName=plc.text("B"))]
    found += [read(), read()]
    assert found == [ERR_FUB_BUSY, 0, ERR_FUB_BUSY]


@pytest.mark.parametrize("missing", ["pDeviceName", "pChannelName"])
def test_a_name_that_is_missing(plc, channels, missing):
    given = {"pDeviceName": plc.text("A"), "pChannelName": plc.text("B"), missing: 0}
    for block in channels():
        assert block.finish(**given) == IOAC_PARAMETER


def test_a_channel_that_is_a_tag_has_its_value(make_plc, channels):
    module = StructType("Module", [Member("AnalogInput01", INT)])
    plc = make_plc(channels=StructType("IoMap", [Member("X20AI4622", module)]))
    tags = plc.controller.tags
    tags.write(tags.find("IoMap.X20AI4622.AnalogInput01"), -2)
    read, _ = channels(plc)
    given = {"pDeviceName": plc.text("X20AI4622"), "pChannelName": plc.text("AnalogInput01")}
    assert read.finish(**given) == 0
    assert read["value"] == 0xFFFE


def test_an_object_of_a_powerlink_node_is_read_back(plc):
    read, write = (
        plc.model(name, {**PLACE, "pData": UDINT, "datalen": UDINT}, {**STATUS, "readlen": UDINT})
        for name in ("EplSDORead", "EplSDOWrite")
    )
    device, target = plc.text("SL1.SS1.IF1"), plc.bytes(b"\xff" * 8)
    assert write.finish(pDevice=device, pData=plc.bytes(b"\1\2\3"), datalen=3, **AT) == 0
    assert read.finish(pDevice=device, pData=target, datalen=8, **AT) == 0
    assert (read["readlen"], plc.memory.read(target, 4)) == (3, b"\1\2\3\xff")
    assert read.finish(datalen=2, node=4) == 0
    assert (read["readlen"], plc.memory.read(target, 4)) == (2, b"\0\0\3\xff")
    assert read.finish(pData=0) == 0


def test_an_object_of_a_canopen_node_is_read_back_by_both_kinds_of_blocks(plc):
    device = plc.text("IF1")
    write = plc.model("CANopenSDOWrite8", {**PLACE, **EIGHT}, STATUS)
    read = plc.model("CANopenSDORead8", PLACE, {**STATUS, **EIGHT})
    assert write.finish(pDevice=device, data0=7, data1=9, data2=1, datalen=2, **AT) == 0
    assert read.finish(pDevice=device, **AT) == 0
    assert [read[name] for name in ("datalen", "data0", "data1", "data2")] == [2, 7, 9, 0]
    assert read.finish(subindex=2) == 0
    assert [read[name] for name in ("datalen", "data0")] == [4, 0]
    target = plc.bytes(bytes(8))
    long_read = plc.model(
        "CANopenSDOReadData",
        {**PLACE, "pRxdata": UDINT, "maxlength": UDINT},
        {**STATUS, "rxlength": UDINT},
    )
    long_write = plc.model(
        "CANopenSDOWriteData", {**PLACE, "pTxdata": UDINT, "txlength": UDINT}, STATUS
    )
    assert long_read.finish(pDevice=device, pRxdata=target, maxlength=8, **AT) == 0
    assert (long_read["rxlength"], plc.memory.read(target, 2)) == (2, b"\7\t")
    assert long_write.finish(pDevice=device, pTxdata=plc.bytes(b"name"), txlength=4, **AT) == 0
    assert long_read.finish() == 0
    assert plc.memory.read(target, 4) == b"name"
