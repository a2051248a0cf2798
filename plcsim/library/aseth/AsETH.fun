(* Library AsETH: IP addresses as numbers; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION ethInetAton : UINT (*an IP address as a number in network order*)
	VAR_INPUT
		pIpStr : UDINT; (*address of the text, 16 bytes*)
		pIpAdr : UDINT; (*address for the number*)
	END_VAR
END_FUNCTION

FUNCTION ethInetNtoa : UINT (*an IP address as text*)
	VAR_INPUT
		ipAdr : UDINT; (*number in network order*)
		pIpStr : UDINT; (*address of the text, 16 bytes*)
	END_VAR
END_FUNCTION
