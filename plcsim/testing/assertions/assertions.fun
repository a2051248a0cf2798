(* Assertions of tests in Structured Text; their names are those of TcUnit. *)

FUNCTION AssertTrue : BOOL (* ends the test where Condition is not TRUE *)
	VAR_INPUT
		Condition : BOOL;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertFalse : BOOL (* ends the test where Condition is not FALSE *)
	VAR_INPUT
		Condition : BOOL;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_BOOL : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : BOOL;
		Actual : BOOL;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_SINT : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : SINT;
		Actual : SINT;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_USINT : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : USINT;
		Actual : USINT;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_INT : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : INT;
		Actual : INT;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_UINT : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : UINT;
		Actual : UINT;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_DINT : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : DINT;
		Actual : DINT;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_UDINT : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : UDINT;
		Actual : UDINT;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_LINT : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : LINT;
		Actual : LINT;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_ULINT : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : ULINT;
		Actual : ULINT;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_BYTE : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : BYTE;
		Actual : BYTE;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_WORD : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : WORD;
		Actual : WORD;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_DWORD : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : DWORD;
		Actual : DWORD;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_LWORD : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : LWORD;
		Actual : LWORD;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_TIME : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : TIME;
		Actual : TIME;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_DATE_AND_TIME : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : DATE_AND_TIME;
		Actual : DATE_AND_TIME;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_STRING : BOOL (* ends the test where both differ *)
	VAR_INPUT
		Expected : STRING[255];
		Actual : STRING[255];
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_REAL : BOOL (* ends the test where both differ by more than Delta *)
	VAR_INPUT
		Expected : REAL;
		Actual : REAL;
		Delta : REAL;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION AssertEquals_LREAL : BOOL (* ends the test where both differ by more than Delta *)
	VAR_INPUT
		Expected : LREAL;
		Actual : LREAL;
		Delta : LREAL;
		Message : STRING[255] := '';
	END_VAR
END_FUNCTION

FUNCTION TEST_FINISHED : BOOL (* a test that calls this runs cycle by cycle until it does *)
END_FUNCTION
