"""Statuses, methods and phases, as the vendor's AsHttp.var has them."""

from __future__ import annotations

from typing import Final

BUFFER_SIZE: Final = 35550
DATA_SIZE: Final = 35551
INVALID_PARAM: Final = 35554
METHOD_UNSUPPORTED: Final = 35556
CLIENT_ERR_SOCKET_CREATE: Final = 35559
CLIENT_TCP_CONN_FAILED: Final = 35562
CLIENT_TCP_INVALID_HOST: Final = 35563
CLIENT_TCP_DISCONNECTED: Final = 35564
NOT_FOUND: Final = 35565
ILLEGAL_CHARACTERS: Final = 35566
SSL_HANDSHAKE_FAILED: Final = 35567
"""httpERR_..."""

METHODS: Final = {1: "GET", 2: "POST", 3: "PUT", 4: "DELETE"}
"""httpMETHOD_..."""

OPTION_HTTP_11: Final = 1
"""httpOPTION_HTTP_11; 0 is HTTP/1.0."""

NOT_CONNECTED: Final = 0
SENDING: Final = 1
RECEIVING: Final = 2
RECEIVED: Final = 3
"""httpPHASE_..."""
