(* Library AsTCP: TCP for programs. The function blocks with the member names, types and order that
   B&R gives them. This file is the source of their interface; the Python classes beside it are
   compared with it by a test. *)

{REDUND_CONTEXT} {REDUND_UNREPLICABLE} FUNCTION_BLOCK TcpOpen (*opens a socket; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pIfAddr : UDINT; (*address of the interface's IP address as a STRING, 0 for all interfaces*)
		port : UINT; (*port, 0 for any free one*)
		options : UDINT; (*tcpOPT_REUSEADDR*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_...*)
		ident : UDINT; (*the socket*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

{REDUND_CONTEXT} {REDUND_UNREPLICABLE} FUNCTION_BLOCK TcpOpenSsl (*opens a socket for SSL; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pIfAddr : UDINT; (*address of the interface's IP address as a STRING, 0 for all interfaces*)
		port : UINT; (*port, 0 for any free one*)
		sslCfgIdent : UDINT; (*SSL configuration*)
		options : UDINT; (*tcpOPT_REUSEADDR*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*ERR_NOTIMPLEMENTED or ERR_FUB_ENABLE_FALSE*)
		ident : UDINT; (*the socket*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

{REDUND_CONTEXT} {REDUND_UNREPLICABLE} FUNCTION_BLOCK TcpServer (*waits for a client; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*socket of TcpOpen*)
		backlog : UDINT; (*clients that may queue*)
		pIpAddr : UDINT; (*address of 16 bytes for the client's IP address, 0 for none*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_...*)
		identclnt : UDINT; (*the client's socket*)
		portclnt : UINT; (*the client's port*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

{REDUND_CONTEXT} {REDUND_UNREPLICABLE} FUNCTION_BLOCK TcpClient (*connects to a server; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*socket of TcpOpen*)
		pServer : UDINT; (*address of the server's IP address as a STRING*)
		portserv : UINT; (*the server's port*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_...*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*start of a time limit, ms*)
	END_VAR
END_FUNCTION_BLOCK

{REDUND_CONTEXT} {REDUND_UNREPLICABLE} FUNCTION_BLOCK TcpClose (*closes a socket and frees its ident; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the socket*)
		how : UDINT; (*0, or tcpSHUT_RD and tcpSHUT_WR: what is shut down first*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_...*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

{REDUND_CONTEXT} {REDUND_UNREPLICABLE} FUNCTION_BLOCK TcpSend (*sends data; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the socket*)
		pData : UDINT; (*address of the data*)
		datalen : UDINT; (*bytes to send*)
		flags : UDINT; (*tcpMSG_OOB, tcpMSG_DONTROUTE*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_...*)
		sentlen : UDINT; (*bytes taken*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

{REDUND_CONTEXT} {REDUND_UNREPLICABLE} FUNCTION_BLOCK TcpRecv (*receives data; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the socket*)
		pData : UDINT; (*address of the buffer*)
		datamax : UDINT; (*bytes of the buffer*)
		flags : UDINT; (*tcpMSG_OOB, tcpMSG_PEEK*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_...*)
		recvlen : UDINT; (*bytes received; 0 with status 0: the other side has finished*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

{REDUND_CONTEXT} {REDUND_UNREPLICABLE} FUNCTION_BLOCK TcpIoctl (*reads and sets options of a socket; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the socket*)
		ioctl : UDINT; (*what to do: tcpSO_..., tcpTCP_..., tcpID_...*)
		pData : UDINT; (*address of the value*)
		datalen : UDINT; (*bytes of the value*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or tcpERR_...*)
		outlen : UDINT; (*bytes stored at pData*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK
