(* Library AsArLog: logbooks as Automation Runtime had them before ArEventLog; its function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK AsArLogCreate (*makes a logbook; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pName : UDINT; (*address of its name*)
		len : UDINT; (*bytes of it*)
		memType : UDINT; (*arlogDRAM, arlogUSRRAM or arlogUSRROM*)
	END_VAR
	VAR
		intResult : UDINT;
		intState : UDINT;
		intRes : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*of the logbook*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsArLogDelete (*deletes a logbook; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*of the logbook*)
	END_VAR
	VAR
		intResult : UDINT;
		intState : UDINT;
		intRes : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsArLogWrite (*writes an entry; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*of the logbook*)
		logLevel : UDINT; (*arlogLEVEL_INFO, _WARNING or _FATAL*)
		errornr : UDINT;
		mem : UDINT; (*address of binary data, 0 for none*)
		len : UDINT; (*bytes of it*)
		asciiString : UDINT; (*address of a text, 0 for none*)
	END_VAR
	VAR
		intResult : UDINT;
		intState : UDINT;
		intRes : UDINT;
		intTaskName : ARRAY[0..35] OF USINT;
		intRtkTime : ARRAY[0..3] OF UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsArLogRead (*reads an entry; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*of the logbook*)
		index : UDINT; (*of the entry*)
		arlogRead : UDINT; (*address of an asarlogRead*)
		memBin : UDINT; (*where the binary data goes, 0 for nowhere*)
		lenBin : UDINT; (*bytes there are for it*)
		memAscii : UDINT; (*where the text goes, 0 for nowhere*)
		lenAscii : UDINT; (*bytes there are for it*)
	END_VAR
	VAR
		intResult : UDINT;
		intState : UDINT;
		intRes : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsArLogClear (*deletes all entries; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*of the logbook*)
	END_VAR
	VAR
		intResult : UDINT;
		intState : UDINT;
		intRes : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsArLogGetInfo (*finds a logbook by its name*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pName : UDINT; (*address of its name*)
	END_VAR
	VAR
		intResult : UDINT;
		intState : UDINT;
		intRes : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*of the logbook*)
		len : UDINT; (*bytes of it*)
		memType : UDINT; (*of it*)
		actualIndex : UDINT; (*of the latest entry*)
		FormatVer : UDINT; (*of its entries*)
	END_VAR
END_FUNCTION_BLOCK
