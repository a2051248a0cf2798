(* Library ArEventLog: logbooks of events; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK ArEventLogCreate (*makes a logbook; asynchronous*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Name : STRING[256]; (*of the logbook*)
		Size : UDINT;
		Persistence : USINT;
		Info : UDINT;
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Busy : BOOL; (*at work*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		Ident : ArEventLogIdentType; (*the logbook*)
	END_VAR
	VAR
		Internal : ArEventLogAsyncInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogDelete (*deletes a logbook; asynchronous*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Ident : ArEventLogIdentType; (*the logbook*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Busy : BOOL; (*at work*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
	END_VAR
	VAR
		Internal : ArEventLogAsyncInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogGetIdent (*finds a logbook by its name*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Name : STRING[256]; (*of the logbook*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		Ident : ArEventLogIdentType; (*the logbook*)
	END_VAR
	VAR
		Internal : ArEventLogInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogWrite (*writes a record*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Ident : ArEventLogIdentType; (*the logbook*)
		EventID : DINT; (*severity, area, facility and code*)
		OriginRecordID : ArEventLogRecordIDType; (*record that led to this one, 0 for none*)
		ObjectID : STRING[36]; (*what the event is about*)
		AddDataSize : UDINT; (*bytes*)
		AddDataFormat : USINT; (*arEVENTLOG_ADDFORMAT_...*)
		AddData : UDINT; (*address of the additional data*)
		TimeStamp : UDINT; (*address of an ArEventLogTimeStampType, 0 for now*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		RecordID : ArEventLogRecordIDType; (*number of the record, 0 for none*)
	END_VAR
	VAR
		Internal : ArEventLogInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogGetLatestRecordID (*the latest record*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Ident : ArEventLogIdentType; (*the logbook*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		RecordID : ArEventLogRecordIDType; (*number of the record, 0 for none*)
	END_VAR
	VAR
		Internal : ArEventLogInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogGetPreviousRecordID (*the record before another*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Ident : ArEventLogIdentType; (*the logbook*)
		RecordID : ArEventLogRecordIDType; (*number of the record, 0 for none*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		PrevRecordID : ArEventLogRecordIDType; (*number of the record before, 0 for none*)
	END_VAR
	VAR
		Internal : ArEventLogInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogRead (*reads a record*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Ident : ArEventLogIdentType; (*the logbook*)
		RecordID : ArEventLogRecordIDType; (*number of the record, 0 for none*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		EventID : DINT; (*severity, area, facility and code*)
		OriginRecordID : ArEventLogRecordIDType; (*record that led to this one, 0 for none*)
		AddDataFormat : USINT; (*arEVENTLOG_ADDFORMAT_...*)
		AddDataSize : UDINT; (*bytes*)
		TimeStamp : ArEventLogTimeStampType; (*seconds since 1970, and nanoseconds*)
	END_VAR
	VAR
		Internal : ArEventLogInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogReadDescription (*text of an event; asynchronous*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Ident : ArEventLogIdentType; (*the logbook*)
		RecordID : ArEventLogRecordIDType; (*number of the record, 0 for none*)
		LanguageCode : ArEventLogLanguageCodeType;
		Qualifier : STRING[250];
		TextBuffer : UDINT; (*address for the text*)
		TextBufferSize : UDINT; (*bytes there*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Busy : BOOL; (*at work*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		TextSize : UDINT; (*bytes of the text, with the NUL*)
	END_VAR
	VAR
		Internal : ArEventLogAsyncInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogReadErrorNumber (*code and severity of a record*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Ident : ArEventLogIdentType; (*the logbook*)
		RecordID : ArEventLogRecordIDType; (*number of the record, 0 for none*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		ErrorNumber : UDINT; (*code of the event*)
		Severity : USINT; (*arEVENTLOG_SEVERITY_...*)
	END_VAR
	VAR
		Internal : ArEventLogInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogReadAddData (*additional data of a record*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Ident : ArEventLogIdentType; (*the logbook*)
		RecordID : ArEventLogRecordIDType; (*number of the record, 0 for none*)
		AddData : UDINT; (*address of the additional data*)
		BytesToRead : UDINT; (*bytes at most*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		AddDataSize : UDINT; (*bytes*)
	END_VAR
	VAR
		Internal : ArEventLogInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK ArEventLogReadObjectID (*what a record is about*)
	VAR_INPUT
		Execute : BOOL; (*a rising edge starts the block*)
		Ident : ArEventLogIdentType; (*the logbook*)
		RecordID : ArEventLogRecordIDType; (*number of the record, 0 for none*)
	END_VAR
	VAR_OUTPUT
		Done : BOOL; (*finished*)
		Error : BOOL; (*failed, StatusID tells why*)
		StatusID : DINT; (*0 or an error*)
		ObjectID : STRING[36]; (*what the event is about*)
	END_VAR
	VAR
		Internal : ArEventLogInternalType;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION ArEventLogMakeEventID : DINT (*puts an event of the user's area together*)
	VAR_INPUT
		Severity : USINT; (*arEVENTLOG_SEVERITY_...*)
		Facility : UINT;
		ErrorCode : UINT;
	END_VAR
END_FUNCTION

FUNCTION ArEventLogIsError : BOOL (*whether an event is an error*)
	VAR_INPUT
		EventID : DINT; (*severity, area, facility and code*)
	END_VAR
END_FUNCTION

FUNCTION ArEventLogIsWarning : BOOL (*whether an event is a warning*)
	VAR_INPUT
		EventID : DINT; (*severity, area, facility and code*)
	END_VAR
END_FUNCTION

FUNCTION ArEventLogIsInformation : BOOL (*whether an event is an information*)
	VAR_INPUT
		EventID : DINT; (*severity, area, facility and code*)
	END_VAR
END_FUNCTION

FUNCTION ArEventLogIsSuccess : BOOL (*whether an event is a success*)
	VAR_INPUT
		EventID : DINT; (*severity, area, facility and code*)
	END_VAR
END_FUNCTION

FUNCTION ArEventLogIsCustomerArea : BOOL (*whether an event is of the user's area*)
	VAR_INPUT
		EventID : DINT; (*severity, area, facility and code*)
	END_VAR
END_FUNCTION

FUNCTION ArEventLogAddDataInit : BOOL (*begins coded additional data*)
	VAR_INPUT
		Buffer : UDINT;
		BufferSize : UDINT;
		Format : USINT;
	END_VAR
END_FUNCTION

FUNCTION ArEventLogAddDataUdint : BOOL (*appends a UDINT*)
	VAR_INPUT
		Buffer : UDINT;
		BufferSize : UDINT;
		Value : UDINT;
	END_VAR
END_FUNCTION

FUNCTION ArEventLogAddDataDint : BOOL (*appends a DINT*)
	VAR_INPUT
		Buffer : UDINT;
		BufferSize : UDINT;
		Value : DINT;
	END_VAR
END_FUNCTION

FUNCTION ArEventLogAddDataString : BOOL (*appends a string*)
	VAR_INPUT
		Buffer : UDINT;
		BufferSize : UDINT;
		Value : UDINT;
	END_VAR
END_FUNCTION

FUNCTION ArEventLogAddDataQuantity : BOOL (*appends a quantity*)
	VAR_INPUT
		Buffer : UDINT;
		BufferSize : UDINT;
		Value : LREAL;
		UnitID : DINT;
		NamespaceURI : UDINT;
	END_VAR
END_FUNCTION
