"""A project on disk: plc.toml, its tables, its extensions."""
