/* What the C library of Linux chooses its declarations by: here everything is declared. */
