(* Library AsUSB: USB devices; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK UsbNodeListGet (*lists devices; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pBuffer : UDINT; (*address for the data*)
		bufferSize : UDINT; (*bytes there*)
		filterInterfaceClass : UINT;
		filterInterfaceSubClass : UINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		allNodes : UDINT; (*devices*)
		listNodes : UDINT; (*devices in the list*)
		attachDetachCount : UDINT; (*changes*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK UsbNodeGet (*data of a device; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		nodeId : UDINT;
		pBuffer : UDINT; (*address for the data*)
		bufferSize : UDINT; (*bytes there*)
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

FUNCTION_BLOCK UsbDescriptorGet (*descriptor of a device; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		nodeId : UDINT;
		requestType : USINT;
		descriptorType : USINT;
		descriptorIndex : USINT;
		languageId : UINT;
		pBuffer : UDINT; (*address for the data*)
		bufferSize : UINT; (*bytes there*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		actSize : UINT;
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK UsbMsDeviceReady (*whether a mass storage is ready; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pIfName : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ready : BOOL;
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK
