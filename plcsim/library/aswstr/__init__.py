"""Library AsWStr: strings of 16-bit characters by their addresses, as AsBrWStr has them."""
