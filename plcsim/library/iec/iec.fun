(* Library iec: what IEC 61131-3 has beside the library standard: counters of each integer type,
   timers of LTIME, dates of their parts, conversions of 64 bits to and from text. *)

FUNCTION_BLOCK CTU_INT (*up-counter*)
	VAR_INPUT
		CU : BOOL; (*counts with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		PV : INT; (*limit that Q compares with*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV >= PV*)
		CV : INT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CU at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTU_DINT (*up-counter*)
	VAR_INPUT
		CU : BOOL; (*counts with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		PV : DINT; (*limit that Q compares with*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV >= PV*)
		CV : DINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CU at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTU_LINT (*up-counter*)
	VAR_INPUT
		CU : BOOL; (*counts with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		PV : LINT; (*limit that Q compares with*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV >= PV*)
		CV : LINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CU at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTU_UDINT (*up-counter*)
	VAR_INPUT
		CU : BOOL; (*counts with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		PV : UDINT; (*limit that Q compares with*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV >= PV*)
		CV : UDINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CU at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTU_ULINT (*up-counter*)
	VAR_INPUT
		CU : BOOL; (*counts with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		PV : ULINT; (*limit that Q compares with*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV >= PV*)
		CV : ULINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CU at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTD_INT (*down-counter*)
	VAR_INPUT
		CD : BOOL; (*counts with its rising edge*)
		LD : BOOL; (*sets CV to PV*)
		PV : INT; (*start of the count*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV <= 0*)
		CV : INT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CD at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTD_DINT (*down-counter*)
	VAR_INPUT
		CD : BOOL; (*counts with its rising edge*)
		LD : BOOL; (*sets CV to PV*)
		PV : DINT; (*start of the count*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV <= 0*)
		CV : DINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CD at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTD_LINT (*down-counter*)
	VAR_INPUT
		CD : BOOL; (*counts with its rising edge*)
		LD : BOOL; (*sets CV to PV*)
		PV : LINT; (*start of the count*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV <= 0*)
		CV : LINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CD at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTD_UDINT (*down-counter*)
	VAR_INPUT
		CD : BOOL; (*counts with its rising edge*)
		LD : BOOL; (*sets CV to PV*)
		PV : UDINT; (*start of the count*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV <= 0*)
		CV : UDINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CD at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTD_ULINT (*down-counter*)
	VAR_INPUT
		CD : BOOL; (*counts with its rising edge*)
		LD : BOOL; (*sets CV to PV*)
		PV : ULINT; (*start of the count*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV <= 0*)
		CV : ULINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CD at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTUD_INT (*up-down-counter*)
	VAR_INPUT
		CU : BOOL; (*counts up with its rising edge*)
		CD : BOOL; (*counts down with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		LD : BOOL; (*sets CV to PV*)
		PV : INT; (*limit, and what LD loads*)
	END_VAR
	VAR_OUTPUT
		QU : BOOL; (*TRUE where CV >= PV*)
		QD : BOOL; (*TRUE where CV <= 0*)
		CV : INT; (*count*)
	END_VAR
	VAR
		MU : BOOL; (*CU at the last call*)
		MD : BOOL; (*CD at the last call*)
		up : BOOL; (*CU has risen*)
		down : BOOL; (*CD has risen*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTUD_DINT (*up-down-counter*)
	VAR_INPUT
		CU : BOOL; (*counts up with its rising edge*)
		CD : BOOL; (*counts down with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		LD : BOOL; (*sets CV to PV*)
		PV : DINT; (*limit, and what LD loads*)
	END_VAR
	VAR_OUTPUT
		QU : BOOL; (*TRUE where CV >= PV*)
		QD : BOOL; (*TRUE where CV <= 0*)
		CV : DINT; (*count*)
	END_VAR
	VAR
		MU : BOOL; (*CU at the last call*)
		MD : BOOL; (*CD at the last call*)
		up : BOOL; (*CU has risen*)
		down : BOOL; (*CD has risen*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTUD_LINT (*up-down-counter*)
	VAR_INPUT
		CU : BOOL; (*counts up with its rising edge*)
		CD : BOOL; (*counts down with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		LD : BOOL; (*sets CV to PV*)
		PV : LINT; (*limit, and what LD loads*)
	END_VAR
	VAR_OUTPUT
		QU : BOOL; (*TRUE where CV >= PV*)
		QD : BOOL; (*TRUE where CV <= 0*)
		CV : LINT; (*count*)
	END_VAR
	VAR
		MU : BOOL; (*CU at the last call*)
		MD : BOOL; (*CD at the last call*)
		up : BOOL; (*CU has risen*)
		down : BOOL; (*CD has risen*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTUD_UDINT (*up-down-counter*)
	VAR_INPUT
		CU : BOOL; (*counts up with its rising edge*)
		CD : BOOL; (*counts down with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		LD : BOOL; (*sets CV to PV*)
		PV : UDINT; (*limit, and what LD loads*)
	END_VAR
	VAR_OUTPUT
		QU : BOOL; (*TRUE where CV >= PV*)
		QD : BOOL; (*TRUE where CV <= 0*)
		CV : UDINT; (*count*)
	END_VAR
	VAR
		MU : BOOL; (*CU at the last call*)
		MD : BOOL; (*CD at the last call*)
		up : BOOL; (*CU has risen*)
		down : BOOL; (*CD has risen*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTUD_ULINT (*up-down-counter*)
	VAR_INPUT
		CU : BOOL; (*counts up with its rising edge*)
		CD : BOOL; (*counts down with its rising edge*)
		R : BOOL; (*sets CV to 0*)
		LD : BOOL; (*sets CV to PV*)
		PV : ULINT; (*limit, and what LD loads*)
	END_VAR
	VAR_OUTPUT
		QU : BOOL; (*TRUE where CV >= PV*)
		QD : BOOL; (*TRUE where CV <= 0*)
		CV : ULINT; (*count*)
	END_VAR
	VAR
		MU : BOOL; (*CU at the last call*)
		MD : BOOL; (*CD at the last call*)
		up : BOOL; (*CU has risen*)
		down : BOOL; (*CD has risen*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TON_LTIME (*on-delay timer for LTIME, in steps of 1 ms*)
	VAR_INPUT
		IN : BOOL; (*starts the timer*)
		PT : LTIME; (*length*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*result*)
		ET : LTIME; (*time that has run, up to PT*)
	END_VAR
	VAR
		timer : TON; (*that measures in ms*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK LTON (*on-delay timer for LTIME as CODESYS calls it, in steps of 1 ms*)
	VAR_INPUT
		IN : BOOL; (*starts the timer*)
		PT : LTIME; (*length*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*result*)
		ET : LTIME; (*time that has run, up to PT*)
	END_VAR
	VAR
		timer : TON; (*that measures in ms*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TON_TIME (*on-delay timer under the name of its type*)
	VAR_INPUT
		IN : BOOL; (*starts the timer*)
		PT : TIME; (*length*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*result*)
		ET : TIME; (*time that has run, up to PT*)
	END_VAR
	VAR
		timer : TON; (*that measures*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TOF_LTIME (*off-delay timer for LTIME, in steps of 1 ms*)
	VAR_INPUT
		IN : BOOL; (*starts the timer*)
		PT : LTIME; (*length*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*result*)
		ET : LTIME; (*time that has run, up to PT*)
	END_VAR
	VAR
		timer : TOF; (*that measures in ms*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK LTOF (*off-delay timer for LTIME as CODESYS calls it, in steps of 1 ms*)
	VAR_INPUT
		IN : BOOL; (*starts the timer*)
		PT : LTIME; (*length*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*result*)
		ET : LTIME; (*time that has run, up to PT*)
	END_VAR
	VAR
		timer : TOF; (*that measures in ms*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TOF_TIME (*off-delay timer under the name of its type*)
	VAR_INPUT
		IN : BOOL; (*starts the timer*)
		PT : TIME; (*length*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*result*)
		ET : TIME; (*time that has run, up to PT*)
	END_VAR
	VAR
		timer : TOF; (*that measures*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TP_LTIME (*pulse timer for LTIME, in steps of 1 ms*)
	VAR_INPUT
		IN : BOOL; (*starts the timer*)
		PT : LTIME; (*length*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*result*)
		ET : LTIME; (*time that has run, up to PT*)
	END_VAR
	VAR
		timer : TP; (*that measures in ms*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK LTP (*pulse timer for LTIME as CODESYS calls it, in steps of 1 ms*)
	VAR_INPUT
		IN : BOOL; (*starts the timer*)
		PT : LTIME; (*length*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*result*)
		ET : LTIME; (*time that has run, up to PT*)
	END_VAR
	VAR
		timer : TP; (*that measures in ms*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TP_TIME (*pulse timer under the name of its type*)
	VAR_INPUT
		IN : BOOL; (*starts the timer*)
		PT : TIME; (*length*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*result*)
		ET : TIME; (*time that has run, up to PT*)
	END_VAR
	VAR
		timer : TP; (*that measures*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION CONCAT_DATE_TOD : DT (*date and time of day together*)
	VAR_INPUT
		IN1 : DATE;
		IN2 : TOD;
	END_VAR
END_FUNCTION

FUNCTION CONCAT_TOD : TOD (*time of day of its parts*)
	VAR_INPUT
		HOUR : INT;
		MINUTE : INT;
		SECOND : INT;
		MILLISECOND : INT;
	END_VAR
END_FUNCTION

FUNCTION CONCAT_DATE : DATE (*date of its parts, by the calendar of Gregory*)
	VAR_INPUT
		YEAR : INT;
		MONTH : INT;
		DAY : INT;
	END_VAR
	VAR
		y : DINT;
		m : DINT;
		days : DINT;
	END_VAR
END_FUNCTION

FUNCTION CONCAT_DT : DT (*date and time of its parts; a DT counts whole seconds*)
	VAR_INPUT
		YEAR : INT;
		MONTH : INT;
		DAY : INT;
		HOUR : INT;
		MINUTE : INT;
		SECOND : INT;
		MILLISECOND : INT;
	END_VAR
END_FUNCTION

FUNCTION DAY_OF_WEEK : INT (*0 on Sunday to 6 on Saturday*)
	VAR_INPUT
		IN : DATE;
	END_VAR
END_FUNCTION

FUNCTION ULINT_TO_STRING : STRING[80] (*number in decimal digits*)
	VAR_INPUT
		IN : ULINT;
	END_VAR
	VAR
		rest : ULINT;
		digit : ULINT;
		text : STRING[80];
	END_VAR
END_FUNCTION

FUNCTION LWORD_TO_STRING : STRING[80] (*number in decimal digits*)
	VAR_INPUT
		IN : LWORD;
	END_VAR
END_FUNCTION

FUNCTION LINT_TO_STRING : STRING[80] (*number in decimal digits*)
	VAR_INPUT
		IN : LINT;
	END_VAR
END_FUNCTION

FUNCTION STRING_TO_ULINT : ULINT (*number in the decimal digits at the start*)
	VAR_INPUT
		IN : STRING[80];
	END_VAR
	VAR
		place : INT;
		digit : INT;
		sum : ULINT;
		is_negative : BOOL;
	END_VAR
END_FUNCTION

FUNCTION STRING_TO_LINT : LINT (*number in the decimal digits at the start*)
	VAR_INPUT
		IN : STRING[80];
	END_VAR
END_FUNCTION

FUNCTION STRING_TO_LWORD : LWORD (*number in the decimal digits at the start*)
	VAR_INPUT
		IN : STRING[80];
	END_VAR
END_FUNCTION

FUNCTION CHAR_TO_STRING : STRING[80] (*text of one character, none for the code 0*)
	VAR_INPUT
		IN : BYTE;
	END_VAR
	VAR
		first : REFERENCE TO BYTE;
	END_VAR
END_FUNCTION

FUNCTION STRING_TO_CHAR : BYTE (*code of the first character, 0 for none*)
	VAR_INPUT
		IN : STRING[80];
	END_VAR
	VAR
		first : REFERENCE TO BYTE;
	END_VAR
END_FUNCTION

FUNCTION WCHAR_TO_WSTRING : WSTRING[80] (*text of one character, none for the code 0*)
	VAR_INPUT
		IN : WORD;
	END_VAR
	VAR
		first : REFERENCE TO WORD;
	END_VAR
END_FUNCTION

FUNCTION WSTRING_TO_WCHAR : WORD (*code of the first character, 0 for none*)
	VAR_INPUT
		IN : WSTRING[80];
	END_VAR
	VAR
		first : REFERENCE TO WORD;
	END_VAR
END_FUNCTION

FUNCTION WLEN : INT (*characters of a WSTRING*)
	VAR_INPUT
		IN : WSTRING[32767];
	END_VAR
END_FUNCTION

FUNCTION WLEFT : WSTRING[255] (*the first L characters of a WSTRING*)
	VAR_INPUT
		IN : WSTRING[32767];
		L : INT;
	END_VAR
END_FUNCTION

FUNCTION WRIGHT : WSTRING[255] (*the last L characters of a WSTRING*)
	VAR_INPUT
		IN : WSTRING[32767];
		L : INT;
	END_VAR
	VAR
		size : INT;
		count : INT;
	END_VAR
END_FUNCTION

FUNCTION WMID : WSTRING[255] (*L characters of a WSTRING from position P, which counts from 1*)
	VAR_INPUT
		IN : WSTRING[32767];
		L : INT;
		P : INT;
	END_VAR
	VAR
		size : INT;
		count : INT;
	END_VAR
END_FUNCTION

FUNCTION WCONCAT : WSTRING[255] (*two WSTRINGs, one behind the other*)
	VAR_INPUT
		IN1 : WSTRING[32767];
		IN2 : WSTRING[32767];
	END_VAR
	VAR
		size : INT;
		place : INT;
	END_VAR
END_FUNCTION

FUNCTION WINSERT : WSTRING[255] (*IN2 put into the WSTRING IN1 behind character P*)
	VAR_INPUT
		IN1 : WSTRING[32767];
		IN2 : WSTRING[32767];
		P : INT;
	END_VAR
	VAR
		place : INT;
	END_VAR
END_FUNCTION

FUNCTION WDELETE : WSTRING[255] (*a WSTRING without the L characters from position P*)
	VAR_INPUT
		IN : WSTRING[32767];
		L : INT;
		P : INT;
	END_VAR
END_FUNCTION

FUNCTION WREPLACE : WSTRING[255] (*the WSTRING IN1 with IN2 in place of the L characters from position P*)
	VAR_INPUT
		IN1 : WSTRING[32767];
		IN2 : WSTRING[32767];
		L : INT;
		P : INT;
	END_VAR
	VAR
		size : INT;
		place : INT;
		rest : INT;
	END_VAR
END_FUNCTION

FUNCTION WFIND : INT (*position of the first IN2 in the WSTRING IN1, 0 for none*)
	VAR_INPUT
		IN1 : WSTRING[32767];
		IN2 : WSTRING[32767];
	END_VAR
	VAR
		place : INT;
		last : INT;
		size : INT;
		found : INT;
	END_VAR
END_FUNCTION
