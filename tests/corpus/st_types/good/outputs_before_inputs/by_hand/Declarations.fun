(* geprüft für alle Geräte *)

function_block Backwards
  var
    Inner : dint;
  end_var
  var_output
    Done : bool;
  end_var
  var_input
    Start : bool;
  end_var
  var_output
    Error : uint;
  end_var
end_function_block
