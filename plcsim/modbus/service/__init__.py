"""Modbus TCP: HMIs read and write the tags of the map.

`pdu` decodes requests and encodes answers by pymodbus, which nothing else here knows. `handler`
executes one request on a `device`. `connection` makes requests out of bytes and bytes out of
answers, without a socket. `server` brings sockets, limits and TLS, `process` all of it into a
process beside the scan.
"""
