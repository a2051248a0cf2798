/* INIT of the thesis' TCP server (figure 1.3): prepare TcpOpen and call it a first time. */

#include "thesis_server.h"

UINT counter;
UINT codex;
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
