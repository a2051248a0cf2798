"""What crosnode brings to the command line: ``plcsim ros``, ``plcsim master``."""
