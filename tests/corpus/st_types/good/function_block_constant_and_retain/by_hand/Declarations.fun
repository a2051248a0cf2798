(* geprüft für alle Geräte *)

function_block CountParts
  var constant
    SIZE : uint := 16;
    IDLE : int := 0;
  end_var
  var_input
    Enable : bool;
  end_var
  var retain
    Total : udint;
  end_var
  var
    History : array[0..SIZE] of uint;
    State : int := IDLE;
  end_var
end_function_block
