(* geprüft für alle Geräte *)

function_block DriveBelt (*moves the belt*) (*$GROUP=User,$CAT=User*)
  var_input
    Enable : bool; (*run*)
    Speed : real; (*m/s*)
  end_var
  var_output
    Active : bool;
    Status : uint;
  end_var
  var
    Ramp : real;
    Delay : TON;
  end_var
end_function_block
function_block DriveTwo
  var
    Left : DriveBelt;
    Right : DriveBelt := (Speed:=0.5);
  end_var
end_function_block
