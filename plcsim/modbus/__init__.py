"""Tags over Modbus TCP: map, exports, service, command, testing."""
