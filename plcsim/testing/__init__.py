"""What tests of plcsim projects use; never imported at run time."""
