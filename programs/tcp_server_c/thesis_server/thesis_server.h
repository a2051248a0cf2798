/* The variables of the thesis' TCP server (figure 1.2); all files of the program mean the same. */

#include <bur/plctypes.h>
#include <AsTCP.h>
#include <string.h>

#ifdef _DEFAULT_INCLUDES
	#include <AsDefault.h>
#endif

extern UINT counter;
extern UINT codex;
extern BOOL serv_ready;
extern BOOL recv_ready;
extern BOOL send_ready;
extern BOOL close_ready;
extern char buffer[100];
extern SINT ipAddr[10];

extern TcpOpen_typ TcpOpen_1;
extern TcpServer_typ TcpServer_1;
extern TcpSend_typ TcpSend_1;
extern TcpClose_typ TcpClose_1;
extern TcpRecv_typ TcpRecv_1;
