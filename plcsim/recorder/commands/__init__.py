"""``plcsim replay`` and ``plcsim bag``."""
