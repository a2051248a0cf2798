
TYPE
	ResultType : STRUCT
		Code : UINT;
	END_STRUCT;
END_TYPE
FUNCTION Evaluate : ResultType
	VAR_INPUT
		pData : UDINT;
	END_VAR
END_FUNCTION
