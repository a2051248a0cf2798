(* Library brsystem: what programs ask of the system they run on; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK MEMInfo (*free memory*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		FreeUSR_Ram : UDINT; (*bytes*)
		FreeSYSTEM : UDINT;
		FreeUSR_Prom : UDINT;
		FreeSYS_Prom : UDINT;
		FreeFIX_Ram : UDINT;
		FreeTMP_Ram : UDINT;
		FreeMEMCARD : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK MEMxInfo (*free memory of one kind*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		mem_typ : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		MemSize : UDINT; (*bytes*)
		FreeMemSize : UDINT; (*bytes*)
		BiggestFreeBlockSize : UDINT; (*bytes*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK SysInfo (*start and version of the system*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		init_reason : USINT; (*INIT_REASON_...*)
		init_count : USINT;
		tick_count : UDINT;
		version : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK RTInfo (*the task class that runs, and why the controller started*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		cycle_time : UDINT; (*microseconds*)
		init_reason : SINT; (*INIT_REASON_...*)
		task_class : SINT; (*number of the task class*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK TARGETInfo (*version and byte order of the system*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pOSVersion : UDINT; (*address of 10 bytes at least*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		DataFormat : USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK HWInfo (*modules of the hardware*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		first : BOOL;
		pName : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		family : USINT;
		usetype : USINT;
		module_typ : UDINT;
		master_no : USINT;
		slave_no : USINT;
		module_adr : USINT;
		slot_no : USINT;
	END_VAR
	VAR
		next_vw_p : UDINT;
		last_modul_p : UDINT;
		next_entry_p : UDINT;
		next_entry_ix : USINT;
		next_slot_ix : USINT;
		last_rio_master : USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK SysconfInfo (*reads an entry of the system configuration*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pEntry : UDINT;
		pValue : UDINT;
		value_len : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK SysconfSet (*writes an entry of the system configuration*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pEntry : UDINT;
		pNewValue : UDINT;
		option : USINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK BatteryInfo (*state of a battery*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		state : USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK EXCInfo (*where an exception came from*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		task_class : UDINT; (*number of the task class*)
		task_ident : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ZYKVLenable (*switches the check of cycle time violations*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		mode : BOOL;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK PMemGet (*reads permanent memory*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		offset : UDINT;
		len : UDINT;
		adress : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK PMemPut (*writes permanent memory*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		offset : UDINT;
		len : UDINT;
		adress : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK PMemSize (*size of permanent memory*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		size : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ARwinWindowsInfo (*state of a Windows beside the controller*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		windowsStatus : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ARwinEthWinInfo (*network of a Windows beside the controller*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		IPAddr : STRING[15];
		SubnetMask : STRING[15];
		MacAddr : ARRAY[0..5] OF BYTE;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION RTTolerance : UDINT (*tolerance of the task class that runs, in microseconds*)
END_FUNCTION

FUNCTION RTCyclic : BOOL (*whether CYCLIC runs*)
END_FUNCTION

FUNCTION RTInit : BOOL (*whether INIT runs*)
END_FUNCTION

FUNCTION RTExit : BOOL (*whether EXIT runs*)
END_FUNCTION

FUNCTION OSVersionMajor : UDINT (*first number of the version*)
END_FUNCTION

FUNCTION OSVersionMinor : UDINT (*second number of the version*)
END_FUNCTION

FUNCTION OSVersionPatch : UDINT (*third number of the version*)
END_FUNCTION

FUNCTION OSVersionBuild : UDINT (*fourth number of the version*)
END_FUNCTION

FUNCTION RTCylceTime : UDINT (*cycle time of a task class in microseconds (B&R's own misspelling)*)
	VAR_INPUT
		task_class : SINT; (*number of the task class*)
	END_VAR
END_FUNCTION

FUNCTION RTCycleTime : UDINT (*cycle time of a task class in microseconds*)
	VAR_INPUT
		task_class : SINT; (*number of the task class*)
	END_VAR
END_FUNCTION
