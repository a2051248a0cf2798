(* Library DataObj: named blocks of memory; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK DatObjCreate (*makes a data object; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		grp : USINT;
		pName : UDINT; (*address of the name*)
		len : UDINT; (*bytes*)
		MemType : USINT; (*doUSRROM, doUSRRAM, ...*)
		Option : UDINT; (*doNO_CS*)
		pCpyData : UDINT; (*address of the first contents, 0 for zeros*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*the data object*)
		pDatObjMem : UDINT; (*address of the contents*)
	END_VAR
	VAR
		i_state : UDINT; (*0 idle, 1 busy*)
		i_result : UDINT; (*last status*)
		i_spare : ARRAY[0..104] OF USINT;
		i_spare_1 : UDINT;
		i_spare_2 : UINT;
		i_spare_3 : UDINT;
		i_spare_4 : USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DatObjWrite (*writes into a data object*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the data object*)
		Offset : UDINT; (*bytes from the start*)
		pSource : UDINT; (*address of the bytes*)
		len : UDINT; (*bytes*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DatObjRead (*reads from a data object*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the data object*)
		Offset : UDINT; (*bytes from the start*)
		pDestination : UDINT; (*address for the bytes*)
		len : UDINT; (*bytes*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DatObjDelete (*deletes a data object; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the data object*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UDINT; (*0 idle, 1 busy*)
		i_result : UDINT; (*last status*)
		i_spare : USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DatObjMove (*moves a data object to another memory; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the data object*)
		MemType : USINT; (*doUSRROM, doUSRRAM, ...*)
		Option : UDINT; (*doNO_CS*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		identNew : UDINT;
		pDatObjMem : UDINT; (*address of the contents*)
	END_VAR
	VAR
		i_state : UDINT; (*0 idle, 1 busy*)
		i_result : UDINT; (*last status*)
		i_spare : ARRAY[0..40] OF USINT;
		i_spare_1 : UDINT;
		i_spare_2 : USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DatObjCopy (*copies a data object; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the data object*)
		pNameTarget : UDINT;
		MemTypeTarget : USINT;
		OptionTarget : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		identNew : UDINT;
		pDatObjMemNew : UDINT;
	END_VAR
	VAR
		i_state : UDINT; (*0 idle, 1 busy*)
		i_result : UDINT; (*last status*)
		i_spare : ARRAY[0..40] OF USINT;
		i_spare_1 : UDINT;
		i_spare_2 : USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DatObjInfo (*finds a data object by its name*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pName : UDINT; (*address of the name*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*the data object*)
		pDatObjMem : UDINT; (*address of the contents*)
		len : UDINT; (*bytes*)
		MemType : USINT; (*doUSRROM, doUSRRAM, ...*)
		Option : UDINT; (*doNO_CS*)
		ChangeDate : DATE_AND_TIME;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DatObjChangeDate (*sets the date of a data object*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pName : UDINT; (*address of the name*)
		SetDate : DATE_AND_TIME;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DatObjAttach (*keeps a data object from being deleted*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the data object*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DatObjDetach (*lets a data object be deleted again*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the data object*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK
