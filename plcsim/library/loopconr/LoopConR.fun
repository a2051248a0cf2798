(* Library LoopConR: scaling, limiting and filtering of REAL; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK LCRScal (*a straight line through two points*)
	VAR_INPUT
		x : REAL;
		x1 : REAL; (*x of the first point*)
		y1 : REAL; (*y of the first point*)
		x2 : REAL; (*x of the second point*)
		y2 : REAL; (*y of the second point*)
	END_VAR
	VAR_OUTPUT
		y : REAL;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK LCRLimit (*limits a value*)
	VAR_INPUT
		in : REAL;
		max_value : DINT;
		min_value : DINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		out : DINT;
		max_limit : BOOL; (*TRUE where the value is above*)
		min_limit : BOOL; (*TRUE where the value is below*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK LCRLimScal (*a straight line through two points, limited to what lies between them*)
	VAR_INPUT
		x : REAL;
		x1 : REAL; (*x of the first point*)
		y1 : REAL; (*y of the first point*)
		x2 : REAL; (*x of the second point*)
		y2 : REAL; (*y of the second point*)
	END_VAR
	VAR_OUTPUT
		y : REAL;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK LCRMovAvgFlt (*mean of the latest values*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		x : REAL;
		base : UINT; (*number of values*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		y : REAL;
	END_VAR
	VAR
		sum_old_dbl_1 : DINT;
		sum_old_dbl_2 : DINT;
		p_xold : UDINT;
		i_xold : UINT;
		base_old : UINT;
		enable_old : BOOL;
		bootkey_old : UDINT;
	END_VAR
END_FUNCTION_BLOCK
