"""Programs in ANSI C and C++."""
