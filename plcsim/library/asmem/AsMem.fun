(* Library AsMem: partitions of memory; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK AsMemPartCreate (*makes a partition*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		len : UDINT; (*bytes*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*the partition*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsMemPartDestroy (*gives a partition back*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the partition*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsMemPartAlloc (*reserves a block of a partition*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the partition*)
		len : UDINT; (*bytes*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		mem : UDINT; (*address of the block*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsMemPartAllocClear (*reserves a block of a partition, zeroed*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the partition*)
		len : UDINT; (*bytes*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		mem : UDINT; (*address of the block*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsMemPartRealloc (*changes the size of a block*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the partition*)
		memOld : UDINT; (*address of the block*)
		len : UDINT; (*bytes*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		mem : UDINT; (*address of the block*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsMemPartFree (*gives a block back*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the partition*)
		mem : UDINT; (*address of the block*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK AsMemPartInfo (*what is free in a partition*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the partition*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		numBytesFree : UDINT;
		maxBlockSizeFree : UDINT;
	END_VAR
END_FUNCTION_BLOCK
