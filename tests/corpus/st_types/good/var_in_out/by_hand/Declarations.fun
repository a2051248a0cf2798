(* geprüft für alle Geräte *)

function_block FillTank
  var_input
    Enable : bool;
  end_var
  var_in_out
    Level : real;
    Values : array[0..9] of int;
    Name : string[20];
  end_var
end_function_block
