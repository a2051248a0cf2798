"""AsTCP.fun, .typ and .var are the source of the interface: the code must not drift from them."""

from __future__ import annotations

from importlib.resources import files

import pytest

from plcsim.library import astcp
from plcsim.library.astcp import constants
from st_types.syntax.declarations import parse_text
from st_types.syntax.tree import FunctionBlockDeclaration, TypeBlock, VariableBlock
from st_types.types.derived import Section
from st_types.types.views import type_of

SECTIONS = {
    "VAR_INPUT": Section.INPUT,
    "VAR_OUTPUT": Section.OUTPUT,
    "VAR": Section.INTERNAL,
}
RUNTIME = ["ERR_OK", "ERR_NOTIMPLEMENTED", "ERR_FUB_ENABLE_FALSE", "ERR_FUB_BUSY"]
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


def items(name, kind):
    text = files(astcp).joinpath(name).read_text(encoding="utf-8")
    found = parse_text(text, name).items
    assert found
    assert all(isinstance(item, kind) for item in found)
    return found


def declared_blocks():
    """Return (name, type, section) of each member by name of the block, in order."""
    return {
        block.name: [
            (member.name, member.specification.name, SECTIONS[part.section])
            for part in block.blocks
            for member in part.declarations
        ]
        for block in items("AsTCP.fun", FunctionBlockDeclaration)
    }


def declared_structs():
    return {
        declaration.name: [
            (member.name, member.specification.name, Section.INTERNAL)
            for member in declaration.specification.members
        ]
        for block in items("AsTCP.typ", TypeBlock)
        for declaration in block.declarations
    }


def declared_constants():
    return {
        declaration.name: declaration.initial.constant.value
        for block in items("AsTCP.var", VariableBlock)
        for declaration in block.declarations
        if block.qualifiers == ("CONSTANT",)
    }


def test_all_that_is_declared_is_exported():
    declared = [*declared_blocks(), *declared_structs(), *declared_constants(), *RUNTIME]
    assert sorted(declared) == sorted(astcp.__all__)
    assert sorted([*declared_blocks(), *declared_structs()]) == sorted(LAYOUT)


@pytest.mark.parametrize("name", LAYOUT)
def test_members_are_as_declared(name):
    members = type_of(getattr(astcp, name)).members
    declared = declared_blocks() | declared_structs()
    assert [(m.name, m.data_type.name, m.section) for m in members] == declared[name]


@pytest.mark.parametrize("name", LAYOUT)
def test_layout_is_that_of_the_generated_c_struct(name):
    data_type = type_of(getattr(astcp, name))
    offsets = {m.name: at for m, at in zip(data_type.members, data_type.offsets, strict=True)}
    assert (data_type.size, offsets) == LAYOUT[name]


def test_constants_are_as_declared():
    coded = {name: value for name, value in vars(constants).items() if name.startswith("tcp")}
    assert coded == declared_constants()


def test_statuses_are_uint_and_all_else_is_udint():
    for block in items("AsTCP.var", VariableBlock):
        for constant in block.declarations:
            is_status = constant.name.startswith("tcpERR_")
            assert constant.specification.name == ("UINT" if is_status else "UDINT")
