"""The TCP server of the thesis, figures 1.2 to 1.4, as printed.

Put right is only what its own compiler would refuse: ``codex`` is declared, ``identcInt`` and
``dataLen`` are called what AsTCP calls them, and a brace too many is left out. Comments that the
page has cut off are left out as well.
"""

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.network import Address, Outcome, VirtualNetwork
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

PLC = '[task_class.1]\ncycle = "1ms"\ntolerance = "10ms"\nprograms = ["server"]\n'
SERVER = """
#include <bur/plctypes.h>
#include <AsTCP.h>
#include <string.h>

#ifdef _DEFAULT_INCLUDES
#include <AsDefault.h>
#endif

UINT counter;
UINT codex;
BOOL ioctl_ready;
BOOL serv_ready;
BOOL recv_ready;
BOOL send_ready;
BOOL close_ready;
char buffer[100];
SINT ipAddr[10] = "127.0.0.1";

TcpOpen_typ TcpOpen_1;
TcpServer_typ TcpServer_1;
TcpSend_typ TcpSend_1;
TcpClose_typ TcpClose_1;
TcpRecv_typ TcpRecv_1;

void _INIT ProgramInit(void)
{
    TcpOpen_1.enable = 1;
    TcpOpen_1.pIfAddr = ipAddr;
    TcpOpen_1.port = 22011;

    strcpy(buffer, "");
    counter = 0;
    recv_ready = 1;
    serv_ready = 1;
    send_ready = 1;
    close_ready = 1;
    TcpOpen(&TcpOpen_1);


}

void _CYCLIC ProgramCyclic(void)
{

    if(counter == 2)
    {
        if(TcpOpen_1.status != 0)
        {
            TcpOpen(&TcpOpen_1);
            codex = TcpOpen_1.status;
        }
        else if(serv_ready == 1)
        {
            TcpServer_1.enable = 1;
            TcpServer_1.ident = TcpOpen_1.ident;
            TcpServer_1.backlog = 0;
            TcpServer(&TcpServer_1);
            serv_ready = 0;
            codex = 11;
        }
        else if(TcpServer_1.status != 0)
        {
            TcpServer(&TcpServer_1);
            codex = TcpServer_1.status;
        }
        else if(recv_ready == 1)
        {
            TcpRecv_1.enable = 1;
            TcpRecv_1.ident = TcpServer_1.identclnt;
            TcpRecv_1.pData = &buffer[0];
            TcpRecv_1.datamax = sizeof(buffer);
            TcpRecv(&TcpRecv_1);
            recv_ready = 0; /* initialize */
            codex = 8;
        }
        else if(TcpRecv_1.status != 0)
            TcpRecv(&TcpRecv_1);
        else if(send_ready == 1)
        {
            TcpSend_1.enable = 1;
            TcpSend_1.ident = TcpServer_1.identclnt;
            TcpSend_1.pData = buffer;
            TcpSend_1.datalen = sizeof(buffer);
            TcpSend(&TcpSend_1);
            send_ready = 0; /* initialize */
        }
        else if(TcpSend_1.status != 0)
            TcpSend(&TcpSend_1);
        else if(close_ready == 1)
        {
            TcpClose_1.enable = 1;
            TcpClose_1.ident = TcpServer_1.identclnt;
            TcpClose(&TcpClose_1);
            close_ready = 0; /* initialize */
        }
        else if(TcpClose_1.status != 0)
            TcpClose(&TcpClose_1);
            counter = 0; /* initialize */

    }
    counter++; /* increment */
}
"""


def test_the_server_as_printed_serves_a_client_in_a_1_ms_class(project):
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")
    application = load(read_project(project({"plc.toml": PLC, "server/Main.c": SERVER})))
    clock = VirtualClock()
    host = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    plc = assemble(application, network=host, clock=clock)
    assert plc.boot() is State.RUN
    plc.run(cycles=10)
    client = host.open("", 0).socket
    while client.connect(Address("127.0.0.1", 22011)) is not Outcome.OK:
        plc.run(cycles=1)
    client.send(b"hello")
    data = b""
    for _ in range(60):
        plc.run(cycles=1)
        received = client.recv(200)
        data += received.data
        if received.outcome not in (Outcome.OK, Outcome.WOULD_BLOCK):
            break
    assert data == b"hello" + bytes(95)
    assert received.outcome is Outcome.CLOSED
    assert plc.state is State.RUN
    application.unload()
