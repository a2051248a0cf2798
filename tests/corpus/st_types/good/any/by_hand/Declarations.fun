(* geprüft für alle Geräte *)

function Largest : ANY_NUM
  var_input
    A : ANY_NUM;
    B : ANY_INT;
    C : ANY_REAL;
    D : ANY;
    E : ANY_BIT;
  end_var
end_function
