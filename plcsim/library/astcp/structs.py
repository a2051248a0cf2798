"""Data types of library AsTCP (``AsTCP.typ``)."""

# ruff: noqa: N815  # the members have the controller's names

from __future__ import annotations

from st_types import UDINT, Struct, var


class tcpLINGER_typ(Struct):  # noqa: N801  # the controller's name
    """Value of tcpSO_LINGER_SET and tcpSO_LINGER_GET.

    lOnOff 0 sends unsent data in the background after TcpClose. Otherwise lLinger 0 discards them
    and resets the connection; a time above 0 (seconds) acts as lOnOff 0 does, without waiting.
    """

    lOnOff = var(UDINT)
    lLinger = var(UDINT)


class tcpSO_ADDRESS_typ(Struct):  # noqa: N801  # the controller's name
    """Value of tcpSO_ADDRESS_GET: where to store the socket's own address.

    pPort is the address of a UINT, pIpAddr that of 16 bytes; 0 stores nothing.
    """

    pPort = var(UDINT)
    pIpAddr = var(UDINT)
