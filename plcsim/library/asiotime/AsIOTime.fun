(* Library AsIOTime: times of the I/O cycle; its functions, with the names and types that B&R gives
   them. *)

FUNCTION AsIOTimeStamp : DINT (*the time now, in microseconds*)
END_FUNCTION

FUNCTION AsIOTimeCyclicStart : DINT (*start of the task class's cycle, in microseconds*)
END_FUNCTION
