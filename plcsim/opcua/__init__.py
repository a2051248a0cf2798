"""The controller's tags over OPC UA: the table [opcua], its service process, its address space."""
