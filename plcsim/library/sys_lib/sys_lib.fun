(* Library sys_lib: tasks, variables by name, memory, errors and the clock; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK Byte2Bit
	VAR_INPUT
		byteadr : UDINT;
		length : UINT;
	END_VAR
	VAR_OUTPUT
		bitadr : UDINT;
	END_VAR
	VAR
		bmem000 : BOOL;
		static_val : ARRAY[0..138] OF USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK Bit2Byte
	VAR_INPUT
		bitadr : UDINT;
		length : UINT;
	END_VAR
	VAR_OUTPUT
		byteadr : UDINT;
	END_VAR
	VAR
		byte_00 : USINT;
		byte_01 : USINT;
		byte_02 : USINT;
		byte_03 : USINT;
		byte_04 : USINT;
		byte_05 : USINT;
		byte_06 : USINT;
		byte_07 : USINT;
		byte_08 : USINT;
		byte_09 : USINT;
		byte_10 : USINT;
		byte_11 : USINT;
		byte_12 : USINT;
		byte_13 : USINT;
		byte_14 : USINT;
		byte_15 : USINT;
		bmem000 : BOOL;
		static_val : ARRAY[0..138] OF USINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION KEY_read : UINT
	VAR_INPUT
		keys : UDINT;
	END_VAR
END_FUNCTION

FUNCTION KEY_enadis : UINT
	VAR_INPUT
		mode : BOOL;
	END_VAR
END_FUNCTION

FUNCTION DA_fix : UINT
	VAR_INPUT
		mo_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DA_info : UINT
	VAR_INPUT
		mo_ident : UDINT;
		moduldata_adr : UDINT;
		moduldata_len : UDINT;
		memorytype : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DA_copy : UINT
	VAR_INPUT
		mo_ident : UDINT;
		new_name : UDINT;
		mem_typ : USINT;
		da_ident : UDINT;
		daten_p : UDINT;
		daten_len : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DA_store : UINT
	VAR_INPUT
		mo_ident : UDINT;
		mem_typ : USINT;
		daten_p : UDINT;
		daten_len : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DA_burn : UINT
	VAR_INPUT
		mo_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DA_delete : UINT
	VAR_INPUT
		mo_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DA_ident : UINT
	VAR_INPUT
		name_p : UDINT;
		grp : USINT;
		mo_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DA_read : UINT
	VAR_INPUT
		mo_ident : UDINT;
		data_p : UDINT;
		data_len : UDINT; (*address for the length*)
		mo_data_offset : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DA_write : UINT
	VAR_INPUT
		mo_ident : UDINT;
		data_p : UDINT;
		data_len : UDINT; (*address for the length*)
		mo_data_offset : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DA_create : UINT
	VAR_INPUT
		name_p : UDINT;
		grp : USINT;
		spooladr : UINT;
		data_len : UDINT; (*address for the length*)
		data_p : UDINT;
		mo_data_p : UDINT;
		mo_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION DIS_clr : UINT
	VAR_INPUT
		dummy_input : USINT;
	END_VAR
END_FUNCTION

FUNCTION DIS_chr : UINT
	VAR_INPUT
		row : UDINT;
		col : UDINT;
		character : SINT;
	END_VAR
END_FUNCTION

FUNCTION DIS_str : UINT
	VAR_INPUT
		row : UDINT;
		col : UDINT;
		string : UDINT;
	END_VAR
END_FUNCTION

FUNCTION ERRxfatal : UINT (*ends the application with an error*)
	VAR_INPUT
		errornr : UINT; (*number of the error*)
		errorinfo : UDINT; (*more about it*)
		errorstring : UDINT; (*address of a text about it*)
	END_VAR
END_FUNCTION

FUNCTION ERR_read : UINT
	VAR_INPUT
		entry_nr : UINT;
		ERR_typ_struct : UDINT;
	END_VAR
END_FUNCTION

FUNCTION ERRxread : UINT
	VAR_INPUT
		entry_nr : UINT;
		ERR_xtyp_struct : UDINT;
	END_VAR
END_FUNCTION

FUNCTION ERR_fatal : UINT (*ends the application with an error*)
	VAR_INPUT
		errornr : UINT; (*number of the error*)
		errorinfo : UDINT; (*more about it*)
	END_VAR
END_FUNCTION

FUNCTION ERR_warning : UINT (*writes a warning into the logbook*)
	VAR_INPUT
		errornr : UINT; (*number of the error*)
		errorinfo : UDINT; (*more about it*)
	END_VAR
END_FUNCTION

FUNCTION ERRxwarning : UINT (*writes a warning into the logbook*)
	VAR_INPUT
		errornr : UINT; (*number of the error*)
		errorinfo : UDINT; (*more about it*)
		errorstring : UDINT; (*address of a text about it*)
	END_VAR
END_FUNCTION

FUNCTION SM_release : UINT
	VAR_INPUT
		sm_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION SM_attach : UINT
	VAR_INPUT
		sm_ident : UDINT;
		timeout : UDINT;
		flags : UDINT;
	END_VAR
END_FUNCTION

FUNCTION SM_delete : UINT
	VAR_INPUT
		sm_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION SM_ident : UINT
	VAR_INPUT
		sm_name : UDINT;
		sm_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION SM_create : UINT
	VAR_INPUT
		sm_name : UDINT;
		sm_count : USINT;
		sm_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION TIM_ticks : UINT (*ticks of 10 ms in the current second*)
END_FUNCTION

FUNCTION TIM_musec : UINT (*microseconds in the current tick of 10 ms*)
END_FUNCTION

FUNCTION SW_settime : UINT (*sets the date and time*)
	VAR_INPUT
		RTCtime_struct : UDINT; (*address of an RTCtime_typ*)
	END_VAR
END_FUNCTION

FUNCTION SW_gettime : UINT (*reads the date and time*)
	VAR_INPUT
		RTCtime_struct : UDINT; (*address of an RTCtime_typ*)
	END_VAR
END_FUNCTION

FUNCTION RTC_settime : UINT (*sets the date and time*)
	VAR_INPUT
		RTCtime_struct : UDINT; (*address of an RTCtime_typ*)
	END_VAR
END_FUNCTION

FUNCTION RTC_gettime : UINT (*reads the date and time*)
	VAR_INPUT
		RTCtime_struct : UDINT; (*address of an RTCtime_typ*)
	END_VAR
END_FUNCTION

FUNCTION TMP_free : UINT (*gives memory back*)
	VAR_INPUT
		memlng : UDINT; (*bytes*)
		memptr : UDINT; (*address of the block*)
	END_VAR
END_FUNCTION

FUNCTION TMP_alloc : UINT (*reserves memory*)
	VAR_INPUT
		memlng : UDINT; (*bytes*)
		memptr : UDINT; (*address for the address*)
	END_VAR
END_FUNCTION

FUNCTION MEM_free : UINT (*gives memory back*)
	VAR_INPUT
		memlng : UDINT; (*bytes*)
		memptr : UDINT; (*address of the block*)
	END_VAR
END_FUNCTION

FUNCTION MEM_alloc : UINT (*reserves memory*)
	VAR_INPUT
		memlng : UDINT; (*bytes*)
		memptr : UDINT; (*address for the address*)
	END_VAR
END_FUNCTION

FUNCTION AVT_info : UINT
	VAR_INPUT
		av_ident : UDINT;
		av_linkcount : UDINT;
	END_VAR
END_FUNCTION

FUNCTION AVT_release : UINT
	VAR_INPUT
		av_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION AVT_attach : UINT
	VAR_INPUT
		av_ident : UDINT;
		av_info : UDINT;
	END_VAR
END_FUNCTION

FUNCTION AVT_ident : UINT
	VAR_INPUT
		av_name : UDINT;
		av_grp : USINT;
		av_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION AVT_cancel : UINT
	VAR_INPUT
		av_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION AVT_create : UINT
	VAR_INPUT
		av_name : UDINT;
		av_grp : USINT;
		av_info : UDINT;
		av_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION UT_sleep : UINT
	VAR_INPUT
		tickcount : UDINT;
	END_VAR
END_FUNCTION

FUNCTION UT_exit : UINT
	VAR_INPUT
		exitinfo : UDINT;
	END_VAR
END_FUNCTION

FUNCTION UT_freemsg : UINT
	VAR_INPUT
		msglng : UDINT;
		msg : UDINT;
	END_VAR
END_FUNCTION

FUNCTION UT_recmsg : UINT
	VAR_INPUT
		ut_ident : UDINT;
		msg : UDINT;
		msglng : UDINT;
		flags : UDINT;
	END_VAR
END_FUNCTION

FUNCTION UT_sendmsg : UINT
	VAR_INPUT
		ut_ident : UDINT;
		msg : UDINT;
		msglng : UDINT;
		flags : UDINT;
	END_VAR
END_FUNCTION

FUNCTION UT_resume : UINT
	VAR_INPUT
		ut_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION UT_suspend : UINT
	VAR_INPUT
		ut_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION UT_ident : UINT
	VAR_INPUT
		ut_name : UDINT;
		ut_grp : USINT;
		ut_proc : USINT;
		ut_sps_p : UDINT;
		ut_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION ST_name : UINT (*name of a task*)
	VAR_INPUT
		st_ident : UDINT; (*ident of the task, 0 for the one that calls*)
		st_name_p : UDINT; (*address for its name*)
		st_grp : UDINT; (*address for its group*)
	END_VAR
END_FUNCTION

FUNCTION ST_info : UINT (*state and class of a task*)
	VAR_INPUT
		st_ident : UDINT; (*ident of the task, 0 for the one that calls*)
		state : UDINT;
		tknr : UDINT;
	END_VAR
END_FUNCTION

FUNCTION ST_allsuspend : UINT
	VAR_INPUT
		dummy_input : USINT;
	END_VAR
END_FUNCTION

FUNCTION ST_tmp_resume : UINT (*lets a stopped task go on*)
	VAR_INPUT
		st_ident : UDINT; (*ident of the task, 0 for the one that calls*)
	END_VAR
END_FUNCTION

FUNCTION ST_tmp_suspend : UINT (*stops a task until the controller starts again*)
	VAR_INPUT
		st_ident : UDINT; (*ident of the task, 0 for the one that calls*)
	END_VAR
END_FUNCTION

FUNCTION ST_resume : UINT (*lets a stopped task go on*)
	VAR_INPUT
		st_ident : UDINT; (*ident of the task, 0 for the one that calls*)
	END_VAR
END_FUNCTION

FUNCTION ST_suspend : UINT (*stops a task*)
	VAR_INPUT
		st_ident : UDINT; (*ident of the task, 0 for the one that calls*)
	END_VAR
END_FUNCTION

FUNCTION ST_ident : UINT (*ident of a task*)
	VAR_INPUT
		st_name : UDINT;
		st_grp : USINT; (*address for its group*)
		st_ident : UDINT; (*ident of the task, 0 for the one that calls*)
	END_VAR
END_FUNCTION

FUNCTION FORCE_info : UINT
	VAR_INPUT
		tknr : USINT;
		force : UDINT;
	END_VAR
END_FUNCTION

FUNCTION MO_ver : UINT
	VAR_INPUT
		pName : UDINT;
		grp : USINT;
		pMoVerStruc : UDINT;
	END_VAR
END_FUNCTION

FUNCTION MO_list : UINT
	VAR_INPUT
		prev_index : UINT;
		index : UDINT;
		MO_List_struct : UDINT;
	END_VAR
END_FUNCTION

FUNCTION_BLOCK MO_info
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		pName : UDINT;
		grp : USINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		type : USINT;
		state : USINT;
		memType : UDINT;
		address : UDINT;
		size : UDINT;
		version : ARRAY[0..9] OF USINT;
		date : RTCtime_typ;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION SYS_battery : USINT
	VAR_INPUT
		dummy_input : USINT;
	END_VAR
END_FUNCTION

FUNCTION SYSreset : UINT (*restarts the controller*)
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		mode : USINT;
	END_VAR
END_FUNCTION

FUNCTION SYSxinfo : UINT
	VAR_INPUT
		SYSxinfo_struct : UDINT;
	END_VAR
END_FUNCTION

FUNCTION SYS_info : UINT
	VAR_INPUT
		init_count : UDINT;
		init_descr : UDINT;
		tick_count : UDINT;
		version : UDINT;
		ov_version : UDINT;
	END_VAR
END_FUNCTION

FUNCTION PV_xlist : UINT
	VAR_INPUT
		prev_index : UINT;
		index : UDINT;
		PV_xList_struct : UDINT;
	END_VAR
END_FUNCTION

FUNCTION PV_ninfo : UINT (*type, length and dimension of a variable by its name*)
	VAR_INPUT
		pv_name : UDINT; (*address of the name*)
		data_typ_p : UDINT; (*address for the type, SYSLIB_IEC_TYPE_...*)
		data_len_p : UDINT; (*address for the length of an element*)
		dimension_p : UDINT; (*address for the number of elements or members*)
	END_VAR
END_FUNCTION

FUNCTION PV_item : UINT (*name of a member of a structure*)
	VAR_INPUT
		pv_name : UDINT; (*address of the name*)
		index : UINT;
		itemname : UDINT; (*address for the name*)
	END_VAR
END_FUNCTION

FUNCTION PV_ident : UINT
	VAR_INPUT
		pv_name : UDINT; (*address of the name*)
		pv_tknr : USINT;
		pv_grp : USINT;
		pv_ident : UDINT;
	END_VAR
END_FUNCTION

FUNCTION PV_list : UINT
	VAR_INPUT
		prev_index : UINT;
		index : UDINT;
		PVList_struct : UDINT;
	END_VAR
END_FUNCTION

FUNCTION PV_info : UINT
	VAR_INPUT
		pv_ident : UDINT;
		data_typ : UDINT;
		data_len : UDINT; (*address for the length*)
		dimension : UDINT;
	END_VAR
END_FUNCTION

FUNCTION PV_xgetval : UINT
	VAR_INPUT
		pv_ident : UDINT;
		subindex : UINT;
		data_p : UDINT;
		data_len : USINT; (*address for the length*)
	END_VAR
END_FUNCTION

FUNCTION PV_xsetval : UINT
	VAR_INPUT
		pv_ident : UDINT;
		subindex : UINT;
		data_p : UDINT;
		data_len : USINT; (*address for the length*)
	END_VAR
END_FUNCTION

FUNCTION PV_xgetadr : UINT (*address and length of a variable by its name*)
	VAR_INPUT
		pv_name_p : UDINT; (*address of the name*)
		pv_adresse : UDINT; (*address for the address*)
		data_len : UDINT; (*address for the length*)
	END_VAR
END_FUNCTION

FUNCTION PV_getadr : UINT
	VAR_INPUT
		pv_name_p : UDINT; (*address of the name*)
		pv_tknr : USINT;
		pv_grpnr : USINT;
		pv_adresse : UDINT; (*address for the address*)
	END_VAR
END_FUNCTION

FUNCTION PV_getval : UINT
	VAR_INPUT
		pv_ident : UDINT;
		value : UDINT;
	END_VAR
END_FUNCTION

FUNCTION PV_setval : UINT
	VAR_INPUT
		pv_ident : UDINT;
		value : UDINT;
	END_VAR
END_FUNCTION

FUNCTION_BLOCK slMoList
	VAR_INPUT
		enable : BOOL; (*run the block; FALSE resets it*)
		first : BOOL;
		filter : BOOL;
		pMoName : UDINT;
		sizeMoName : UDINT;
		pAppMoName : UDINT;
		sizeAppMoName : UDINT;
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_BUSY, ERR_FUB_ENABLE_FALSE or an error*)
		moSize : UDINT;
		moType : USINT;
		memType : USINT;
	END_VAR
	VAR
		i_hMo : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION MO_versionMajor : UDINT
	VAR_INPUT
		pName : UDINT;
	END_VAR
END_FUNCTION

FUNCTION MO_versionMinor : UDINT
	VAR_INPUT
		pName : UDINT;
	END_VAR
END_FUNCTION

FUNCTION MO_versionPatch : UDINT
	VAR_INPUT
		pName : UDINT;
	END_VAR
END_FUNCTION

FUNCTION MO_versionBuild : UDINT
	VAR_INPUT
		pName : UDINT;
	END_VAR
END_FUNCTION

FUNCTION PV_lkaddr : UINT
	VAR_INPUT
		pv_address : UDINT;
		pv_name_buf : UDINT;
		pv_name_buf_size : UDINT;
	END_VAR
END_FUNCTION
