(* geprüft für alle Geräte *)

function_block Controller
  var_input
    Gain : real := 1.0;
    Period : time := T#1s;
    Mode : usint := 16#03;
    Text : string[80] := 'ready';
  end_var
end_function_block
