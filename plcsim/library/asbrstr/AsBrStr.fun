(* Library AsBrStr: memory and strings by their addresses; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION brsftoa : UINT (*writes a number as text; returns its length*)
	VAR_INPUT
		value : REAL;
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION brsatof : REAL (*reads a number*)
	VAR_INPUT
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION brsatod : LREAL (*reads a number*)
	VAR_INPUT
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION brsitoa : UINT (*writes a number as text; returns its length*)
	VAR_INPUT
		value : DINT;
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION brsatoi : DINT (*reads a number*)
	VAR_INPUT
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION brsmemset : UDINT (*fills bytes; returns pDest*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		value : USINT;
		length : UDINT; (*bytes*)
	END_VAR
END_FUNCTION

FUNCTION brsmemcpy : UDINT (*copies bytes; returns pDest*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		pSrc : UDINT; (*address of the source*)
		length : UDINT; (*bytes*)
	END_VAR
END_FUNCTION

FUNCTION brsmemmove : UDINT (*copies bytes that may overlap; returns pDest*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		pSrc : UDINT; (*address of the source*)
		length : UDINT; (*bytes*)
	END_VAR
END_FUNCTION

FUNCTION brsmemcmp : DINT (*compares bytes: below 0, 0, above 0*)
	VAR_INPUT
		pMem1 : UDINT;
		pMem2 : UDINT;
		length : UDINT; (*bytes*)
	END_VAR
END_FUNCTION

FUNCTION brsstrcat : UDINT (*appends a string; returns the address of its end*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		pSrc : UDINT; (*address of the source*)
	END_VAR
END_FUNCTION

FUNCTION brsstrlen : UDINT (*length of a string*)
	VAR_INPUT
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION brsstrcpy : UDINT (*copies a string; returns the address of its end*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		pSrc : UDINT; (*address of the source*)
	END_VAR
END_FUNCTION

FUNCTION brsstrcmp : DINT (*compares strings: below 0, 0, above 0*)
	VAR_INPUT
		pString1 : UDINT;
		pString2 : UDINT;
	END_VAR
END_FUNCTION
