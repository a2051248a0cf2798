
FUNCTION_BLOCK (* name *) Odd (* odd *)
	VAR_INPUT (* inputs *)
		A (*a*) : (*is*) ARRAY (*of*) [ (*from*) 0 .. (*to*) 3 ] (*of*) OF (*what*) INT;
	END_VAR (* inputs *)
	VAR (* inner *) RETAIN (* kept *)
		B : REFERENCE (*to*) TO (*what*) INT;
	END_VAR
END_FUNCTION_BLOCK // Odd
