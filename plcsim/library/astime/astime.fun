(* Library astime: date, time of day and differences of them; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK DTExSetTime (*sets the date and time, with options*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		DT1 : DATE_AND_TIME; (*date and time*)
		Option : USINT; (*timEXSETTIME_NO_LOGENTRY: no entry in the logbook*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DTSetTime (*sets the date and time*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		DT1 : DATE_AND_TIME; (*date and time*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DTGetTime (*reads the date and time*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		DT1 : DATE_AND_TIME; (*date and time*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION clock_ms : TIME (*milliseconds on the controller's clock*)
END_FUNCTION

FUNCTION_BLOCK UtcDTGetTime (*reads the date and time in UTC*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		DT1 : DATE_AND_TIME; (*date and time*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK UtcDTSetTime (*sets the date and time in UTC; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		DT1 : DATE_AND_TIME; (*date and time*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK UtcDTExSetTime (*sets the date and time in UTC, with options; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		DT1 : DATE_AND_TIME; (*date and time*)
		Option : USINT; (*timEXSETTIME_NO_LOGENTRY: no entry in the logbook*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DTStructureGetTime (*reads the date and time as a structure*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DTStructureSetTime (*sets the date and time from a structure*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DTStructureExSetTime (*sets the date and time from a structure, with options*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDTStructure : UDINT; (*address of a DTStructure*)
		Option : USINT; (*timEXSETTIME_NO_LOGENTRY: no entry in the logbook*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK UtcDTStructureGetTime (*reads the date and time in UTC as a structure*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK UtcDTStructureSetTime (*sets the date and time in UTC from a structure; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK UtcDTStructureExSetTime (*sets the date and time in UTC from a structure, with options; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDTStructure : UDINT; (*address of a DTStructure*)
		Option : USINT; (*timEXSETTIME_NO_LOGENTRY: no entry in the logbook*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK UtcDT_TO_LocalDTStructure (*UTC to local time; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		DT1 : DATE_AND_TIME; (*date and time*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK LocalDT_TO_UtcDTStructure (*local time to UTC; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		DT1 : DATE_AND_TIME; (*date and time*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK UtcDTStructure_TO_LocalDT (*UTC to local time; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
	VAR_OUTPUT
		DT1 : DATE_AND_TIME; (*date and time*)
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK LocalDTStructure_TO_UtcDT (*local time to UTC; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
	VAR_OUTPUT
		DT1 : DATE_AND_TIME; (*date and time*)
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION ascTIMEStructure : UDINT (*a duration as text, 15:14:13*)
	VAR_INPUT
		pTIMEStructure : UDINT; (*address of a TIMEStructure*)
		pStr : UDINT; (*address of the text*)
		len : UDINT; (*bytes there, with the NUL*)
	END_VAR
END_FUNCTION

FUNCTION ascDTStructure : UDINT (*a date and time as text, Sun Jan 3 15:14:13 1988*)
	VAR_INPUT
		pDTStructure : UDINT; (*address of a DTStructure*)
		pStr : UDINT; (*address of the text*)
		len : UDINT; (*bytes there, with the NUL*)
	END_VAR
END_FUNCTION

FUNCTION ascTIME : UDINT (*a duration as text, 15:14:13*)
	VAR_INPUT
		TIME1 : TIME;
		pStr : UDINT; (*address of the text*)
		len : UDINT; (*bytes there, with the NUL*)
	END_VAR
END_FUNCTION

FUNCTION ascDT : UDINT (*a date and time as text, Sun Jan 3 15:14:13 1988*)
	VAR_INPUT
		DT1 : DATE_AND_TIME; (*date and time*)
		pStr : UDINT; (*address of the text*)
		len : UDINT; (*bytes there, with the NUL*)
	END_VAR
END_FUNCTION

FUNCTION TIMEStructure_TO_TIME : TIME (*puts a duration together*)
	VAR_INPUT
		pTIMEStructure : UDINT; (*address of a TIMEStructure*)
	END_VAR
END_FUNCTION

FUNCTION TIME_TO_TIMEStructure : UDINT (*takes a duration apart*)
	VAR_INPUT
		TIME1 : TIME;
		pTIMEStructure : UDINT; (*address of a TIMEStructure*)
	END_VAR
END_FUNCTION

FUNCTION DTStructure_TO_DT : DATE_AND_TIME (*puts a date and time together*)
	VAR_INPUT
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
END_FUNCTION

FUNCTION DT_TO_DTStructure : UDINT (*takes a date and time apart*)
	VAR_INPUT
		DT1 : DATE_AND_TIME; (*date and time*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
END_FUNCTION

FUNCTION DiffT : UDINT (*milliseconds from TIME1 to TIME2*)
	VAR_INPUT
		TIME2 : TIME;
		TIME1 : TIME;
	END_VAR
END_FUNCTION

FUNCTION DiffDT : UDINT (*seconds from DT1 to DT2*)
	VAR_INPUT
		DT2 : DATE_AND_TIME;
		DT1 : DATE_AND_TIME; (*date and time*)
	END_VAR
END_FUNCTION

FUNCTION_BLOCK TimeDeviceGetInfo (*what sets the clock; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pServer : UDINT;
		len : USINT; (*bytes there, with the NUL*)
	END_VAR
	VAR_OUTPUT
		timeDevice : USINT; (*timREAL_TIME_CLOCK or timTIME_SERVER*)
		avgDeviation : REAL;
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DstGetInfo (*daylight saving time at a date; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDTStructure : UDINT; (*address of a DTStructure*)
	END_VAR
	VAR_OUTPUT
		dstState : USINT; (*timNORMAL_TIME, timDAYLIGHT_SAVING_TIME or timNO_DST*)
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DstGetInfoDT (*daylight saving time at a date; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		DT1 : DATE_AND_TIME; (*date and time*)
	END_VAR
	VAR_OUTPUT
		dstState : USINT; (*timNORMAL_TIME, timDAYLIGHT_SAVING_TIME or timNO_DST*)
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK
