"""From syntax trees to data types, constants, variables and functions."""
