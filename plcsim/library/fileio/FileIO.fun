(* Library FileIO: files and directories on file devices; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK FileCreate (*creates and opens a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pFile : UDINT; (*address of the file's name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*the open file*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileOpen (*opens a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pFile : UDINT; (*address of the file's name*)
		mode : USINT; (*fiREAD_ONLY, fiWRITE_ONLY or fiREAD_WRITE*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*the open file*)
		filelen : UDINT; (*bytes of the file*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileClose (*closes a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the open file*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileRead (*reads from a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the open file*)
		offset : UDINT; (*bytes from the start of the file*)
		pDest : UDINT; (*address for the bytes*)
		len : UDINT; (*bytes*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileReadEx (*reads from a file and tells how much; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the open file*)
		offset : UDINT; (*bytes from the start of the file*)
		pDest : UDINT; (*address for the bytes*)
		len : UDINT; (*bytes*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		bytesread : UDINT; (*bytes that were read*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileWrite (*writes to a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the open file*)
		offset : UDINT; (*bytes from the start of the file*)
		pSrc : UDINT; (*address of the bytes*)
		len : UDINT; (*bytes*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileWriteEx (*writes to a file, which may end there; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the open file*)
		offset : UDINT; (*bytes from the start of the file*)
		pSrc : UDINT; (*address of the bytes*)
		len : UDINT; (*bytes*)
		option : UDINT;
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileRename (*renames a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pName : UDINT; (*address of the name*)
		pNewName : UDINT; (*address of the new name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileCopy (*copies a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pSrcDev : UDINT; (*address of the device's name*)
		pSrc : UDINT; (*address of the file's name*)
		pDestDev : UDINT; (*address of the other device's name*)
		pDest : UDINT; (*address of the new name*)
		option : USINT;
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileDelete (*deletes a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pName : UDINT; (*address of the name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileInfo (*size and dates of a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pName : UDINT; (*address of the name*)
		pInfo : UDINT; (*address of a fiFILE_INFO*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK FileTruncate (*cuts a file; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pName : UDINT; (*address of the name*)
		newLength : UDINT;
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirCreate (*creates a directory; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pName : UDINT; (*address of the name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirOpen (*opens a directory for DirReadEx; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pName : UDINT; (*address of the name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*the open directory*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirClose (*closes a directory; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the open directory*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirRead (*reads an entry of a directory; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pPath : UDINT; (*address of the path, 0 for all of the device*)
		entry : UDINT; (*number of the entry, from 0*)
		option : USINT;
		pData : UDINT; (*address of a fiDIR_READ_DATA*)
		data_len : UDINT; (*bytes there*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirReadEx (*reads the next entry of a directory; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		ident : UDINT; (*the open directory*)
		pData : UDINT; (*address of a fiDIR_READ_EX_DATA*)
		data_len : UDINT; (*bytes there*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirInfo (*counts the entries of a directory; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pPath : UDINT; (*address of the path, 0 for all of the device*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		dirnum : UDINT; (*directories*)
		filenum : UDINT; (*files*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirRename (*renames a directory; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pName : UDINT; (*address of the name*)
		pNewName : UDINT; (*address of the new name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirCopy (*copies a directory; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pSrcDev : UDINT; (*address of the device's name*)
		pSrcDir : UDINT;
		pDestDev : UDINT; (*address of the other device's name*)
		pDestDir : UDINT;
		option : USINT;
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirDelete (*deletes an empty directory; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pName : UDINT; (*address of the name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DirDeleteEx (*deletes a directory with all in it; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pName : UDINT; (*address of the name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK SetAttributes (*sets attributes; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pPath : UDINT; (*address of the path, 0 for all of the device*)
		attributes : USINT;
		option : USINT;
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK GetAttributes (*reads attributes; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pPath : UDINT; (*address of the path, 0 for all of the device*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		attributes : USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DevMemInfo (*size of a device; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		freemem : UDINT; (*bytes*)
		memsize : UDINT; (*bytes*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DevLink (*makes a device; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pParam : UDINT; (*address of /DEVICE=PATH*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		handle : UDINT; (*the device*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK DevUnlink (*takes a device away; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		handle : UDINT; (*the device*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK GetVolumeLabel (*name of a device's volume; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
		pLabel : UDINT;
		labelMax : UDINT;
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		labelLen : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK GetVolumeSerialNo (*number of a device's volume; asynchronous*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pDevice : UDINT; (*address of the device's name*)
	END_VAR
	VAR
		i_state : UINT; (*0 idle, 1 busy*)
		i_result : UINT; (*last status*)
		i_tmp : UDINT; (*not used*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		serialNo : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION FileIoGetSysError : UINT (*number of the system's last error*)
END_FUNCTION
