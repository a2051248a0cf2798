(* Library standard: the standard function blocks of IEC 61131-3, clause 6.6.3.5 of edition 3,
   with the member names, types and order that B&R gives them. This file is the source of their
   interface; their bodies are in plcsim/ansi_c/libc/src/iec_blocks.c. *)

FUNCTION_BLOCK TON (*on-delay timer*)
	VAR_INPUT
		IN : BOOL; (*starts the timer with its rising edge*)
		PT : TIME; (*delay*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE once IN has been TRUE for PT*)
		ET : TIME; (*time since the rising edge, up to PT*)
	END_VAR
	VAR
		StartTime : TIME; (*low word of the start*)
		M : BOOL; (*IN at the last call*)
		Restart : UDINT; (*high word of the start*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TOF (*off-delay timer*)
	VAR_INPUT
		IN : BOOL; (*starts the timer with its falling edge*)
		PT : TIME; (*delay*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE while IN is, and for PT after it*)
		ET : TIME; (*time since the falling edge, up to PT*)
	END_VAR
	VAR
		M : BOOL; (*IN at the last call*)
		StartTime : TIME; (*low word of the start*)
		Restart : UDINT; (*high word of the start*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TP (*pulse timer*)
	VAR_INPUT
		IN : BOOL; (*starts the pulse with its rising edge*)
		PT : TIME; (*length of the pulse*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE for PT, whatever IN does meanwhile*)
		ET : TIME; (*time since the start of the pulse, up to PT*)
	END_VAR
	VAR
		StartTime : TIME; (*low word of the start*)
		Restart : UDINT; (*high word of the start*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTU (*up-counter*)
	VAR_INPUT
		CU : BOOL; (*counts with its rising edge*)
		RESET : BOOL; (*sets CV to 0; R of IEC 61131-3*)
		PV : UINT; (*limit that Q compares with*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV >= PV*)
		CV : UINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CU at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTD (*down-counter*)
	VAR_INPUT
		CD : BOOL; (*counts with its rising edge*)
		LOAD : BOOL; (*sets CV to PV; LD of IEC 61131-3*)
		PV : UINT; (*value to load*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE where CV = 0*)
		CV : UINT; (*count*)
	END_VAR
	VAR
		M : BOOL; (*CD at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CTUD (*up-down counter*)
	VAR_INPUT
		CU : BOOL; (*counts up with its rising edge*)
		CD : BOOL; (*counts down with its rising edge*)
		RESET : BOOL; (*sets CV to 0; R of IEC 61131-3*)
		LOAD : BOOL; (*sets CV to PV; LD of IEC 61131-3*)
		PV : INT; (*value to load, limit that QU compares with*)
	END_VAR
	VAR_OUTPUT
		QU : BOOL; (*TRUE where CV >= PV*)
		QD : BOOL; (*TRUE where CV <= 0*)
		CV : INT; (*count*)
	END_VAR
	VAR
		MU : BOOL; (*CU at the last call*)
		MD : BOOL; (*CD at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK R_TRIG (*rising edge*)
	VAR_INPUT
		CLK : BOOL; (*signal*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE in the call that sees CLK rise*)
	END_VAR
	VAR
		M : BOOL; (*CLK at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK F_TRIG (*falling edge*)
	VAR_INPUT
		CLK : BOOL; (*signal*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE in the call that sees CLK fall*)
	END_VAR
	VAR
		M : BOOL; (*CLK at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK SR (*bistable, set has priority*)
	VAR_INPUT
		SET1 : BOOL; (*sets Q1; S1 of IEC 61131-3*)
		RESET : BOOL; (*resets Q1; R of IEC 61131-3*)
	END_VAR
	VAR_OUTPUT
		Q1 : BOOL; (*state*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK RS (*bistable, reset has priority*)
	VAR_INPUT
		SET : BOOL; (*sets Q1; S of IEC 61131-3*)
		RESET1 : BOOL; (*resets Q1; R1 of IEC 61131-3*)
	END_VAR
	VAR_OUTPUT
		Q1 : BOOL; (*state*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TON_10ms (*on-delay timer in ticks of 10 ms*)
	VAR_INPUT
		IN : BOOL; (*starts the timer with its rising edge*)
		PT : UDINT; (*ticks*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE once IN has been TRUE for PT*)
		ET : UDINT; (*ticks since then, up to PT*)
	END_VAR
	VAR
		StartTime : UDINT; (*1 + tick of the start*)
		M : BOOL; (*IN at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TOF_10ms (*off-delay timer in ticks of 10 ms*)
	VAR_INPUT
		IN : BOOL; (*starts the timer with its falling edge*)
		PT : UDINT; (*ticks*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE while IN is, and for PT after it*)
		ET : UDINT; (*ticks since then, up to PT*)
	END_VAR
	VAR
		M : BOOL; (*IN at the last call*)
		StartTime : UDINT; (*1 + tick of the start*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TP_10ms (*pulse timer in ticks of 10 ms*)
	VAR_INPUT
		IN : BOOL; (*starts the pulse with its rising edge*)
		PT : UDINT; (*ticks*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*the pulse*)
		ET : UDINT; (*ticks since then, up to PT*)
	END_VAR
	VAR
		StartTime : UDINT; (*1 + tick of the start*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK RF_TRIG (*both edges*)
	VAR_INPUT
		CLK : BOOL; (*signal*)
	END_VAR
	VAR_OUTPUT
		Q : BOOL; (*TRUE in the call that sees CLK change*)
	END_VAR
	VAR
		M : BOOL; (*CLK at the last call*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK SEMA (*semaphore*)
	VAR_INPUT
		CLAIM : BOOL; (*claims it*)
		RELEASE : BOOL; (*gives it back*)
	END_VAR
	VAR_OUTPUT
		BUSY : BOOL; (*it was claimed before*)
	END_VAR
	VAR
		X : BOOL; (*it is claimed*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION LEN : INT (*characters of a string*)
	VAR_INPUT
		IN : STRING[32767];
	END_VAR
END_FUNCTION

FUNCTION LEFT : STRING[255] (*the first L characters*)
	VAR_INPUT
		IN : STRING[32767];
		L : INT;
	END_VAR
END_FUNCTION

FUNCTION RIGHT : STRING[255] (*the last L characters*)
	VAR_INPUT
		IN : STRING[32767];
		L : INT;
	END_VAR
END_FUNCTION

FUNCTION MID : STRING[255] (*L characters from position P, which counts from 1*)
	VAR_INPUT
		IN : STRING[32767];
		L : INT;
		P : INT;
	END_VAR
END_FUNCTION

FUNCTION CONCAT : STRING[255] (*two strings, one behind the other*)
	VAR_INPUT
		IN1 : STRING[32767];
		IN2 : STRING[32767];
	END_VAR
END_FUNCTION

FUNCTION INSERT : STRING[255] (*IN2 put into IN1 behind character P*)
	VAR_INPUT
		IN1 : STRING[32767];
		IN2 : STRING[32767];
		P : INT;
	END_VAR
END_FUNCTION

FUNCTION DELETE : STRING[255] (*a string without the L characters from position P*)
	VAR_INPUT
		IN : STRING[32767];
		L : INT;
		P : INT;
	END_VAR
END_FUNCTION

FUNCTION REPLACE : STRING[255] (*IN1 with IN2 in place of the L characters from position P*)
	VAR_INPUT
		IN1 : STRING[32767];
		IN2 : STRING[32767];
		L : INT;
		P : INT;
	END_VAR
END_FUNCTION

FUNCTION FIND : INT (*position of the first IN2 in IN1, 0 for none*)
	VAR_INPUT
		IN1 : STRING[32767];
		IN2 : STRING[32767];
	END_VAR
END_FUNCTION
