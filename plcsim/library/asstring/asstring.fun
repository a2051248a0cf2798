(* Library asstring: memory and strings by their addresses; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION ftoa : UINT (*writes a number as text; returns its length*)
	VAR_INPUT
		value : REAL;
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION atof : REAL (*reads a number*)
	VAR_INPUT
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION itoa : UINT (*writes a number as text; returns its length*)
	VAR_INPUT
		value : DINT;
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION atoi : DINT (*reads a number*)
	VAR_INPUT
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION memset : UDINT (*fills bytes; returns pDest*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		value : USINT;
		length : UDINT; (*bytes*)
	END_VAR
END_FUNCTION

FUNCTION memcpy : UDINT (*copies bytes; returns pDest*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		pSrc : UDINT; (*address of the source*)
		length : UDINT; (*bytes*)
	END_VAR
END_FUNCTION

FUNCTION memmove : UDINT (*copies bytes that may overlap; returns pDest*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		pSrc : UDINT; (*address of the source*)
		length : UDINT; (*bytes*)
	END_VAR
END_FUNCTION

FUNCTION memcmp : DINT (*compares bytes: below 0, 0, above 0*)
	VAR_INPUT
		pMem1 : UDINT;
		pMem2 : UDINT;
		length : UDINT; (*bytes*)
	END_VAR
END_FUNCTION

FUNCTION strcat : UDINT (*appends a string; returns pDest*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		pSrc : UDINT; (*address of the source*)
	END_VAR
END_FUNCTION

FUNCTION strlen : UINT (*length of a string*)
	VAR_INPUT
		pString : UDINT; (*address of the string*)
	END_VAR
END_FUNCTION

FUNCTION strcpy : UDINT (*copies a string; returns pDest*)
	VAR_INPUT
		pDest : UDINT; (*address of the target*)
		pSrc : UDINT; (*address of the source*)
	END_VAR
END_FUNCTION

FUNCTION strcmp : DINT (*compares strings: below 0, 0, above 0*)
	VAR_INPUT
		pString1 : UDINT;
		pString2 : UDINT;
	END_VAR
END_FUNCTION
