(* Library dvframe: serial interfaces; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK FRM_mode (*changes the mode of an interface*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the interface*)
		mode : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		internal : STRING[27];
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FRM_ctrl (*control lines of an interface*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the interface*)
		ioctrl : UINT;
		inarg : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		outarg : UDINT;
	END_VAR
	VAR
		internal : STRING[43];
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FRM_robuf (*gives a buffer for sending back*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the interface*)
		buffer : UDINT;
		buflng : UINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		internal : STRING[27];
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FRM_gbuf (*takes a buffer for sending*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the interface*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		buffer : UDINT;
		buflng : UINT;
	END_VAR
	VAR
		internal : STRING[27];
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FRM_rbuf (*gives a received buffer back*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the interface*)
		buffer : UDINT;
		buflng : UINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		internal : STRING[27];
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FRM_close (*closes an interface*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the interface*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		internal : STRING[27];
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FRM_write (*sends a buffer*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the interface*)
		buffer : UDINT;
		buflng : UINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		internal : STRING[27];
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FRM_writeAcknowledged
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the interface*)
		buffer : UDINT;
		buflng : UINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		internal : STRING[27];
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FRM_read (*receives a buffer*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the interface*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		buffer : UDINT;
		buflng : UINT;
	END_VAR
	VAR
		internal : STRING[27];
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FRM_xopen (*opens an interface*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		device : UDINT;
		mode : UDINT;
		config : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*the interface*)
	END_VAR
	VAR
		internal : STRING[27];
	END_VAR
END_FUNCTION_BLOCK
