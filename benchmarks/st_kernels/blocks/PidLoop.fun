FUNCTION_BLOCK PidLoop
	VAR_INPUT
		setpoint : REAL;
	END_VAR
	VAR_OUTPUT
		actual : REAL;
		limited : BOOL;
	END_VAR
	VAR
		cycles : UDINT;
		ramp : REAL;
		rate : REAL := 10.0;
		kp : REAL := 1.5;
		ki : REAL := 0.2;
		kd : REAL := 0.01;
		dt : REAL := 0.01;
		error : REAL;
		last : REAL;
		integral : REAL;
		derivative : REAL;
		out : REAL;
		out_max : REAL := 200.0;
		out_min : REAL := -200.0;
		integral_max : REAL := 50.0;
	END_VAR
END_FUNCTION_BLOCK
