
FUNCTION Rising : BOOL
	VAR_INPUT
		now : BOOL;
		old : BOOL;
	END_VAR
END_FUNCTION
