
FUNCTION ScaleValue : REAL (*linear*)
	VAR_INPUT
		Value : REAL;
		Factor : REAL := 1.0;
	END_VAR
	VAR
		Help : REAL;
	END_VAR
END_FUNCTION

FUNCTION MakeName : STRING[80]
	VAR_INPUT
		Number : UINT;
	END_VAR
END_FUNCTION

FUNCTION IsSimulated : BOOL
END_FUNCTION
