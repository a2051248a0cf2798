(* Library MTFilter: filters, as far as their formulas are common; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK MTFilterMovingAverage (*mean of the latest values*)
	VAR_INPUT
		Enable : BOOL; (*run the block; FALSE resets it*)
		WindowLength : UINT; (*number of values*)
		Update : BOOL; (*a rising edge takes over the parameters above*)
		In : REAL; (*input*)
	END_VAR
	VAR_OUTPUT
		Active : BOOL; (*it runs*)
		Error : BOOL; (*parameters are wrong, StatusID tells which*)
		StatusID : DINT; (*0 or an error*)
		UpdateDone : BOOL; (*they are taken over*)
		Out : REAL; (*output*)
	END_VAR
	VAR
		Internal : MTFilterMovingAvgInternalType; (*state*)
	END_VAR
END_FUNCTION_BLOCK
