
FUNCTION_BLOCK Ramp (*follows its input in steps*)
	VAR_INPUT
		target : INT;
	END_VAR
	VAR_OUTPUT
		value : INT;
		reached : BOOL;
	END_VAR
	VAR
		settle : TON;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION Share : REAL (*of a whole*)
	VAR_INPUT
		part : UDINT;
		whole : UDINT;
	END_VAR
END_FUNCTION
