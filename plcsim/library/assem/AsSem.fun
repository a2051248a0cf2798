(* Library AsSem: counting semaphores; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK SemCreate (*makes a semaphore*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		initCount : UDINT;
		maxCount : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*the semaphore*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK SemDelete (*deletes a semaphore*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the semaphore*)
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

FUNCTION_BLOCK SemGetInfo (*counts of a semaphore*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the semaphore*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		maxCount : UDINT;
		curCount : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION SemAcquire : UINT (*takes a semaphore without waiting*)
	VAR_INPUT
		ident : UDINT; (*the semaphore*)
	END_VAR
END_FUNCTION

FUNCTION SemRelease : UINT (*gives a semaphore back*)
	VAR_INPUT
		ident : UDINT; (*the semaphore*)
	END_VAR
END_FUNCTION
