(* Library AsARCfg: configuration of the controller; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK CfgGetIPAddr (*reads the IP address of an interface; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		pIPAddr : UDINT;
		Len : USINT; (*bytes there*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgSetIPAddr (*sets the IP address of an interface; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		pIPAddr : UDINT;
		Option : UDINT; (*cfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgGetSubnetMask (*reads the subnet mask of an interface; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		pSubnetMask : UDINT;
		Len : USINT; (*bytes there*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgSetSubnetMask (*sets the subnet mask of an interface; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		pSubnetMask : UDINT;
		Option : UDINT; (*cfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgGetDefaultGateway (*reads the default gateway of an interface; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		pGateway : UDINT;
		Len : USINT; (*bytes there*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgSetDefaultGateway (*sets the default gateway of an interface; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		pGateway : UDINT;
		Option : UDINT; (*cfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgGetBroadcastAddr (*reads the broadcast address of an interface; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		pBroadcastAddr : UDINT;
		Len : USINT; (*bytes there*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgSetBroadcastAddr (*sets the broadcast address of an interface; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		pBroadcastAddr : UDINT;
		Option : UDINT; (*cfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgGetEthConfigMode (*reads where an interface has its address from; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ConfigMode : UDINT; (*cfgCONFIGMODE_MANUALLY or cfgCONFIGMODE_DHCPCLIENT*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgSetEthConfigMode (*sets where an interface has its address from; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		ConfigMode : UDINT; (*cfgCONFIGMODE_MANUALLY or cfgCONFIGMODE_DHCPCLIENT*)
		Option : UDINT; (*cfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgGetHostName (*reads the host name; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pHostName : UDINT;
		Len : USINT; (*bytes there*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgSetHostName (*sets the host name; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pHostName : UDINT;
		Option : UDINT; (*cfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgGetMacAddr (*reads the MAC address of an interface*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the interface's name, such as SL0.SS0.IF3*)
		pMacAddr : UDINT;
		Len : USINT; (*bytes there*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgGetTimeZone (*reads the time zone; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		timezoneID : UINT;
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK CfgSetTimeZone (*sets the time zone; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		timezoneID : UINT;
		option : UDINT; (*cfgOPTION_VOLATILE or cfgOPTION_NON_VOLATILE*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK
