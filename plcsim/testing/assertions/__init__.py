"""The library of assertions that tests in Structured Text call."""
