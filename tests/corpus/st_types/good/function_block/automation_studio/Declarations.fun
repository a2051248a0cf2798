
FUNCTION_BLOCK DriveBelt (*moves the belt*) (*$GROUP=User,$CAT=User*)
	VAR_INPUT
		Enable : BOOL; (*run*)
		Speed : REAL; (*m/s*)
	END_VAR
	VAR_OUTPUT
		Active : BOOL;
		Status : UINT;
	END_VAR
	VAR
		Ramp : REAL;
		Delay : TON;
	END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK DriveTwo
	VAR
		Left : DriveBelt;
		Right : DriveBelt := (Speed:=0.5);
	END_VAR
END_FUNCTION_BLOCK
