(* → dense *) FUNCTION_BLOCK Controller VAR_INPUT Gain:REAL:=1.0;Period:TIME:=T#1s;Mode:USINT:=16#03;Text:STRING[80]:='ready';END_VAR END_FUNCTION_BLOCK 
