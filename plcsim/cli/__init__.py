"""Command line of plcsim."""
