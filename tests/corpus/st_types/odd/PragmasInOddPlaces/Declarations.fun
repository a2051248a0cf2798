{REDUND_CONTEXT}
{REDUND_UNREPLICABLE}

FUNCTION_BLOCK {x} Odd {y}
	{REDUND_UNREPLICABLE} VAR_INPUT {REDUND_UNREPLICABLE}
		{a} enable {b} : {c} BOOL {d} := {e} TRUE {f} ; {g}
	END_VAR {h}
	VAR {i} CONSTANT {j}
		n : INT := 5;
	END_VAR
END_FUNCTION_BLOCK {k}
{attribute 'odd' := 'x y'}
