"""The OPC UA service process; all that knows the library asyncua."""
