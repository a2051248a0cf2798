(* geprüft für alle Geräte *)

{REDUND_CONTEXT} {REDUND_UNREPLICABLE} function_block OpenPort (*asynchronous*)
  var_input
    enable : bool;
  end_var
end_function_block
{REDUND_OK} function PortState : uint
end_function
{REDUND_ERROR} {REDUND_UNREPLICABLE} function_block ClosePort (*TODO*) (*$GROUP=User*)
end_function_block
