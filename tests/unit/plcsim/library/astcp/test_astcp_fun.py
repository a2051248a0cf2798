"""Layout and constants of AsTCP are those of the controller; members follow from AsTCP.fun."""

from __future__ import annotations

import pytest

from plcsim.library import astcp
from plcsim.library.installed import installed
from st_types.types.views import type_of

SEND_RECV_IOCTL = {
    "ident": 0,
    "status": 16,
    "i_state": 24,
    "i_result": 26,
    "i_tmp": 28,
    "enable": 32,
}

# Sizes and offsets that gcc -m32 gives the structs of the generated header SG4/AsTCP.h.
LAYOUT = {
    "TcpOpen": (
        32,
        {"pIfAddr": 0, "port": 4, "options": 8, "status": 12, "ident": 16}
        | {"i_state": 20, "i_result": 22, "i_tmp": 24, "enable": 28},
    ),
    "TcpOpenSsl": (
        36,
        {"pIfAddr": 0, "port": 4, "sslCfgIdent": 8, "options": 12, "status": 16, "ident": 20}
        | {"i_state": 24, "i_result": 26, "i_tmp": 28, "enable": 32},
    ),
    "TcpServer": (
        36,
        {"ident": 0, "backlog": 4, "pIpAddr": 8, "status": 12, "identclnt": 16, "portclnt": 20}
        | {"i_state": 22, "i_result": 24, "i_tmp": 28, "enable": 32},
    ),
    "TcpClient": (
        24,
        {"ident": 0, "pServer": 4, "portserv": 8, "status": 10}
        | {"i_state": 12, "i_result": 14, "i_tmp": 16, "enable": 20},
    ),
    "TcpClose": (
        24,
        {"ident": 0, "how": 4, "status": 8}
        | {"i_state": 10, "i_result": 12, "i_tmp": 16, "enable": 20},
    ),
    "TcpSend": (36, SEND_RECV_IOCTL | {"pData": 4, "datalen": 8, "flags": 12, "sentlen": 20}),
    "TcpRecv": (36, SEND_RECV_IOCTL | {"pData": 4, "datamax": 8, "flags": 12, "recvlen": 20}),
    "TcpIoctl": (36, SEND_RECV_IOCTL | {"ioctl": 4, "pData": 8, "datalen": 12, "outlen": 20}),
    "tcpLINGER_typ": (8, {"lOnOff": 0, "lLinger": 4}),
    "tcpSO_ADDRESS_typ": (8, {"pPort": 0, "pIpAddr": 4}),
}


@pytest.fixture(scope="module")
def scope():
    return installed()["plcsim.library.astcp"].scope


def test_each_block_and_struct_has_its_layout_here(scope):
    assert sorted(t.name for t in scope.data_types()) == sorted(LAYOUT)


@pytest.mark.parametrize("name", LAYOUT)
def test_layout_is_that_of_the_generated_c_struct(scope, name):
    data_type = type_of(getattr(astcp, name))
    assert data_type is scope.find_type(name)
    offsets = {m.name: at for m, at in zip(data_type.members, data_type.offsets, strict=True)}
    assert (data_type.size, offsets) == LAYOUT[name]


def test_statuses_are_uint_and_all_else_is_udint(scope):
    for constant in scope.variables:
        is_status = constant.name.startswith("tcpERR_")
        assert constant.is_constant
        assert str(constant.data_type) == ("UINT" if is_status else "UDINT")
