"""Library asstring: memory and strings by their addresses, as C has them."""
