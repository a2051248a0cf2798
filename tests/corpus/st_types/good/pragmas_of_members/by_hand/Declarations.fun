(* geprüft für alle Geräte *)

{REDUND_UNREPLICABLE} function_block ReadPort
  var_input
    enable : {REDUND_UNREPLICABLE} bool; (*on*)
    list : {REDUND_UNREPLICABLE} array[0..3] of int;
  end_var
  var
    {REDUND_UNREPLICABLE} first : int;
    zzInternal : {REDUND_UNREPLICABLE} usint := 5;
  end_var
end_function_block
