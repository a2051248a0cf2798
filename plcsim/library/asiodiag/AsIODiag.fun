(* Library AsIODiag: what is plugged, and whether the controller is simulated; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK DiagCreateInfo (*makes a list of modules; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		infoKind : UDINT;
	END_VAR
	VAR
		StateMan : UINT;
		ErrMan : UINT;
		Init : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*the list*)
		nrEntries : UDINT; (*modules in the list*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DiagDisposeInfo (*forgets a list of modules*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the list*)
	END_VAR
	VAR
		StateMan : UINT;
		ErrMan : UINT;
		Init : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DiagGetNumInfo (*a number about a module of the list*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the list*)
		index : UDINT;
		infoCode : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		value : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DiagGetStrInfo (*a text about a module of the list*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the list*)
		index : UDINT;
		infoCode : UDINT;
		pBuffer : UDINT;
		bufferLen : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		stringLen : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION DiagCpuIsSimulated : BOOL (*whether the controller is simulated*)
END_FUNCTION

FUNCTION DiagCpuIsARsim : BOOL (*whether the controller is simulated on a PC*)
END_FUNCTION
