(* geprüft für alle Geräte *)

type
  ResultType : struct
    Code : uint;
  end_struct;
end_type
function Evaluate : ResultType
  var_input
    pData : udint;
  end_var
end_function
