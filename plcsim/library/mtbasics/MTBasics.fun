(* Library MTBasics: blocks of control, as far as their formulas are common; its functions and function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK MTBasicsLimiter (*limits a value and its slew rate*)
	VAR_INPUT
		Enable : BOOL; (*run the block; FALSE resets it*)
		MinOut : REAL;
		MaxOut : REAL;
		MaxPosSlewRate : REAL; (*per second; 0 for no limit*)
		MaxNegSlewRate : REAL; (*per second; 0 for no limit*)
		Update : BOOL; (*a rising edge takes over the parameters above*)
		In : REAL; (*input*)
		OutPresetValue : REAL; (*what SetOut sets Out to*)
		SetOut : BOOL; (*a rising edge sets Out*)
	END_VAR
	VAR_OUTPUT
		Active : BOOL; (*it runs*)
		Error : BOOL; (*parameters are wrong, StatusID tells which*)
		StatusID : DINT; (*0 or an error*)
		UpdateDone : BOOL; (*they are taken over*)
		Out : REAL; (*output*)
	END_VAR
	VAR
		Internal : MTBasicsLimiterInternalType; (*state*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK MTBasicsPID (*PID controller*)
	VAR_INPUT
		Enable : BOOL; (*run the block; FALSE resets it*)
		PIDParameters : MTPIDParametersType;
		MinOut : REAL;
		MaxOut : REAL;
		Invert : BOOL; (*for a plant with a falling characteristic*)
		Update : BOOL; (*a rising edge takes over the parameters above*)
		SetValue : REAL;
		ActValue : REAL;
		IntegrationPartPresetValue : REAL;
		SetIntegrationPart : BOOL; (*a rising edge sets the integral part*)
		HoldOut : BOOL; (*keeps Out as it is*)
		TrackingValue : REAL;
		EnableTracking : BOOL; (*Out is TrackingValue*)
		HoldIntegration : MTPIDIntegrationEnum;
	END_VAR
	VAR_OUTPUT
		Busy : BOOL; (*it works on something*)
		Active : BOOL; (*it runs*)
		Error : BOOL; (*parameters are wrong, StatusID tells which*)
		StatusID : DINT; (*0 or an error*)
		UpdateDone : BOOL; (*they are taken over*)
		Out : REAL; (*output*)
		ControlError : REAL; (*SetValue less ActValue*)
		ProportionalPart : REAL;
		IntegrationPart : REAL;
		DerivativePart : REAL;
		TrackingActive : BOOL;
		IntegrationStatus : MTPIDIntegrationEnum;
		SystemReference : UDINT; (*always 0*)
	END_VAR
	VAR
		Internal : MTBasicsPIDInternalType; (*state*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK MTBasicsPT1 (*first-order lag*)
	VAR_INPUT
		Enable : BOOL; (*run the block; FALSE resets it*)
		Gain : REAL; (*amplification*)
		TimeConstant : REAL; (*seconds*)
		Update : BOOL; (*a rising edge takes over the parameters above*)
		In : REAL; (*input*)
		OutPresetValue : REAL; (*what SetOut sets Out to*)
		SetOut : BOOL; (*a rising edge sets Out*)
	END_VAR
	VAR_OUTPUT
		Busy : BOOL; (*it works on something*)
		Active : BOOL; (*it runs*)
		Error : BOOL; (*parameters are wrong, StatusID tells which*)
		StatusID : DINT; (*0 or an error*)
		UpdateDone : BOOL; (*they are taken over*)
		Out : REAL; (*output*)
		SystemReference : UDINT; (*always 0*)
	END_VAR
	VAR
		Internal : MTBasicsPT1InternalType; (*state*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK MTBasicsPWM (*pulse width modulator*)
	VAR_INPUT
		Enable : BOOL; (*run the block; FALSE resets it*)
		Mode : MTBasicsPWMModeEnum; (*where in the period the pulse lies*)
		MinPulseWidth : REAL; (*seconds*)
		Period : REAL; (*seconds*)
		Update : BOOL; (*a rising edge takes over the parameters above*)
		DutyCycle : REAL; (*per cent*)
	END_VAR
	VAR_OUTPUT
		Active : BOOL; (*it runs*)
		Error : BOOL; (*parameters are wrong, StatusID tells which*)
		StatusID : DINT; (*0 or an error*)
		UpdateDone : BOOL; (*they are taken over*)
		Out : BOOL; (*output*)
	END_VAR
	VAR
		Internal : MTBasicsPWMInternalType; (*state*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK MTBasicsTimeDelay (*delays a value*)
	VAR_INPUT
		Enable : BOOL; (*run the block; FALSE resets it*)
		DelayTime : REAL; (*seconds*)
		In : REAL; (*input*)
		InitialValue : REAL; (*output until the delay has passed*)
	END_VAR
	VAR_OUTPUT
		Active : BOOL; (*it runs*)
		Error : BOOL; (*parameters are wrong, StatusID tells which*)
		StatusID : DINT; (*0 or an error*)
		Out : REAL; (*output*)
	END_VAR
	VAR
		Internal : MTBasicsTimeDelayInternalType; (*state*)
	END_VAR
END_FUNCTION_BLOCK
