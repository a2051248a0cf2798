"""Library AsBrStr: memory and strings by their addresses."""
