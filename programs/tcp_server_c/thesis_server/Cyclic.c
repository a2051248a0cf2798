/* CYCLIC of the thesis' TCP server (figure 1.4): one block in every third cycle.
 *
 * Slips of the figure are put right: TcpRecv has datamax and TcpSend datalen, TcpServer identclnt,
 * and the counter counts in the other branch, so that every third cycle is the useful one, as the
 * text says. As in the figure the whole buffer goes back, 100 bytes, and one client is served. */

#include "thesis_server.h"

void _CYCLIC ProgramCyclic(void)
{
	if (counter != 2)
	{
		counter++;
		return;
	}
	counter = 0;
	if (TcpOpen_1.status != 0)
	{
		TcpOpen(&TcpOpen_1);
		codex = TcpOpen_1.status;
	}
	else if (serv_ready == 1) /* wait for a client */
	{
		TcpServer_1.enable = 1;
		TcpServer_1.ident = TcpOpen_1.ident;
		TcpServer_1.backlog = 0;
		TcpServer(&TcpServer_1);
		serv_ready = 0;
		codex = 11;
	}
	else if (TcpServer_1.status != 0)
	{
		TcpServer(&TcpServer_1);
		codex = TcpServer_1.status;
	}
	else if (recv_ready == 1)
	{
		TcpRecv_1.enable = 1;
		TcpRecv_1.ident = TcpServer_1.identclnt;
		TcpRecv_1.pData = &buffer[0];
		TcpRecv_1.datamax = sizeof(buffer);
		TcpRecv(&TcpRecv_1);
		recv_ready = 0;
		codex = 8;
	}
	else if (TcpRecv_1.status != 0)
		TcpRecv(&TcpRecv_1);
	else if (send_ready == 1)
	{
		TcpSend_1.enable = 1;
		TcpSend_1.ident = TcpServer_1.identclnt;
		TcpSend_1.pData = buffer;
		TcpSend_1.datalen = sizeof(buffer);
		TcpSend(&TcpSend_1);
		send_ready = 0;
	}
	else if (TcpSend_1.status != 0)
		TcpSend(&TcpSend_1);
	else if (close_ready == 1)
	{
		TcpClose_1.enable = 1;
		TcpClose_1.ident = TcpServer_1.identclnt;
		TcpClose(&TcpClose_1);
		close_ready = 0;
	}
	else if (TcpClose_1.status != 0)
		TcpClose(&TcpClose_1);
}
