(* geprüft für alle Geräte *)

function ScaleValue : real (*linear*)
  var_input
    Value : real;
    Factor : real := 1.0;
  end_var
  var
    Help : real;
  end_var
end_function

function MakeName : string[80]
  var_input
    Number : uint;
  end_var
end_function

function IsSimulated : bool
end_function
