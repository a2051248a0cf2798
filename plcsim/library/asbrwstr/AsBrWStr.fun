(* Library AsBrWStr: strings of 16-bit characters by their addresses; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION brwcsconv : UDINT (*converts between STRING and WSTRING*)
	VAR_INPUT
		pDestination : REFERENCE TO USINT;
		pSource : REFERENCE TO USINT;
		level : USINT; (*brwU8toUC or brwUCtoU8*)
	END_VAR
END_FUNCTION

FUNCTION brwcsncpy : UDINT (*copies n characters, with zeros behind a short string*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		pSource : REFERENCE TO UINT;
		n : UDINT;
	END_VAR
END_FUNCTION

FUNCTION brwcsncat : UDINT (*appends at most n characters*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		pSource : REFERENCE TO UINT;
		n : UDINT;
	END_VAR
END_FUNCTION

FUNCTION brwcscat : UDINT (*appends a string*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		pSource : REFERENCE TO UINT;
	END_VAR
END_FUNCTION

FUNCTION brwcscmp : DINT (*compares strings*)
	VAR_INPUT
		pUcstr1 : REFERENCE TO UINT;
		pUcstr2 : REFERENCE TO UINT;
	END_VAR
END_FUNCTION

FUNCTION brwcslen : UDINT (*length in characters*)
	VAR_INPUT
		pwcString : REFERENCE TO UINT;
	END_VAR
END_FUNCTION

FUNCTION brwcsset : UDINT (*fills len characters*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		len : UDINT;
		symbol : UINT;
	END_VAR
END_FUNCTION

FUNCTION brwcsncmp : DINT (*compares at most n characters*)
	VAR_INPUT
		pwcString1 : REFERENCE TO UINT;
		pwcString2 : REFERENCE TO UINT;
		n : UDINT;
	END_VAR
END_FUNCTION

FUNCTION brwcscpy : UDINT (*copies a string*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		pSource : REFERENCE TO UINT;
	END_VAR
END_FUNCTION

FUNCTION brwcsrchr : UDINT (*address of the last place of a character, 0 for none*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		symbol : UINT;
	END_VAR
END_FUNCTION

FUNCTION brwcschr : UDINT (*address of the first place of a character, 0 for none*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		symbol : UINT;
	END_VAR
END_FUNCTION
