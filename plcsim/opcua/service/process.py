"""The OPC UA service process; `plcsim.process.service_main` calls `serve`."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError

if TYPE_CHECKING:
    from plcsim.process.service_main import Service


def serve(service: Service) -> None:
    """Serve the address space until asked to stop.

    Raises:
        ConfigurationError: the address cannot be listened on, or a package is missing.
    """
    try:
        from plcsim.opcua.service.server import run  # noqa: PLC0415  # needs the extra
    except ImportError as err:
        raise ConfigurationError(
            f"opcua: needs the package {err.name}; python3 -m pip install 'plcsim[opcua]'"
        ) from None
    logger = logging.getLogger("asyncua")  # what peers do wrong is no news of ours
    logger.addHandler(logging.NullHandler())
    logger.propagate = False
    asyncio.run(run(service))
