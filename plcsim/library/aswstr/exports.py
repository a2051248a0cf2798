"""The functions of the C library that are the bodies of this library's."""

from __future__ import annotations

from typing import Final

from plcsim.library.asbrwstr.exports import EXPORTS as OF_ASBRWSTR

EXPORTS: Final = {name.removeprefix("br"): body for name, body in OF_ASBRWSTR.items()}
