(* Library AsBrMath: mathematics of REAL; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION brmatan2 : REAL (*angle of a point*)
	VAR_INPUT
		y : REAL;
		x : REAL;
	END_VAR
END_FUNCTION

FUNCTION brmceil : REAL (*the next whole number above*)
	VAR_INPUT
		x : REAL;
	END_VAR
END_FUNCTION

FUNCTION brmcosh : REAL (*hyperbolic cosine*)
	VAR_INPUT
		x : REAL;
	END_VAR
END_FUNCTION

FUNCTION brmfloor : REAL (*the next whole number below*)
	VAR_INPUT
		x : REAL;
	END_VAR
END_FUNCTION

FUNCTION brmfmod : REAL (*remainder with the sign of x*)
	VAR_INPUT
		x : REAL;
		y : REAL;
	END_VAR
END_FUNCTION

FUNCTION brmfrexp : REAL (*mantissa and exponent of 2*)
	VAR_INPUT
		x : REAL;
		pExp : UDINT; (*address for the exponent, a DINT*)
	END_VAR
END_FUNCTION

FUNCTION brmldexp : REAL (*x times a power of 2*)
	VAR_INPUT
		x : REAL;
		exp_val : DINT;
	END_VAR
END_FUNCTION

FUNCTION brmmodf : REAL (*fraction and whole part*)
	VAR_INPUT
		x : REAL;
		plp : UDINT; (*address for the whole part, a REAL*)
	END_VAR
END_FUNCTION

FUNCTION brmpow : REAL (*power*)
	VAR_INPUT
		x : REAL;
		y : REAL;
	END_VAR
END_FUNCTION

FUNCTION brmsinh : REAL (*hyperbolic sine*)
	VAR_INPUT
		x : REAL;
	END_VAR
END_FUNCTION

FUNCTION brmtanh : REAL (*hyperbolic tangent*)
	VAR_INPUT
		x : REAL;
	END_VAR
END_FUNCTION
