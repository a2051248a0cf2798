(* geprüft für alle Geräte *)

function_block (* name *) Odd (* odd *)
  var_input (* inputs *)
    A (*a*) : (*is*) array (*of*) [ (*from*) 0 .. (*to*) 3 ] (*of*) of (*what*) int;
  end_var (* inputs *)
  var (* inner *) retain (* kept *)
    B : reference (*to*) to (*what*) int;
  end_var
end_function_block // Odd
