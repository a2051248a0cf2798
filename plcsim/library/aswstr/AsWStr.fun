(* Library AsWStr: strings of 16-bit characters by their addresses; its functions, with the names,
   types and order that B&R gives them. *)

FUNCTION wcsconv : UDINT (*converts between STRING and WSTRING*)
	VAR_INPUT
		pDestination : REFERENCE TO USINT;
		pSource : REFERENCE TO USINT;
		level : USINT;
	END_VAR
END_FUNCTION

FUNCTION wcsncpy : UDINT (*copies n characters, with zeros behind a short string*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		pSource : REFERENCE TO UINT;
		n : UDINT;
	END_VAR
END_FUNCTION

FUNCTION wcsncat : UDINT (*appends at most n characters*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		pSource : REFERENCE TO UINT;
		n : UDINT;
	END_VAR
END_FUNCTION

FUNCTION wcscat : UDINT (*appends a string*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		pSource : REFERENCE TO UINT;
	END_VAR
END_FUNCTION

FUNCTION wcscmp : DINT (*compares strings*)
	VAR_INPUT
		pUcstr1 : REFERENCE TO UINT;
		pUcstr2 : REFERENCE TO UINT;
	END_VAR
END_FUNCTION

FUNCTION wcslen : UDINT (*length in characters*)
	VAR_INPUT
		pwcString : REFERENCE TO UINT;
	END_VAR
END_FUNCTION

FUNCTION wcsset : UDINT (*fills len characters*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		len : UDINT;
		symbol : UINT;
	END_VAR
END_FUNCTION

FUNCTION wcsncmp : DINT (*compares at most n characters*)
	VAR_INPUT
		pwcString1 : REFERENCE TO UINT;
		pwcString2 : REFERENCE TO UINT;
		n : UDINT;
	END_VAR
END_FUNCTION

FUNCTION wcscpy : UDINT (*copies a string*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		pSource : REFERENCE TO UINT;
	END_VAR
END_FUNCTION

FUNCTION wcsrchr : UDINT (*address of the last place of a character, 0 for none*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		symbol : UINT;
	END_VAR
END_FUNCTION

FUNCTION wcschr : UDINT (*address of the first place of a character, 0 for none*)
	VAR_INPUT
		pDestination : REFERENCE TO UINT;
		symbol : UINT;
	END_VAR
END_FUNCTION
