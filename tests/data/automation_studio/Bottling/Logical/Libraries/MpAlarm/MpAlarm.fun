
FUNCTION_BLOCK MpAlarmCore
	VAR_INPUT
		MpLink : REFERENCE TO MpComIdentType;
		Enable : BOOL;
		ErrorReset : BOOL;
	END_VAR
	VAR_OUTPUT
		Active : BOOL;
		Error : BOOL;
		StatusID : DINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION MpAlarmSet : DINT
	VAR_INPUT
		MpLink : REFERENCE TO MpComIdentType;
		Name : STRING[40];
	END_VAR
END_FUNCTION
