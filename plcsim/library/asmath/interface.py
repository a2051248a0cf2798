"""Library AsMath as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

__all__ = [
    "am1_PI",
    "am2_PI",
    "am2_SQRTPI",
    "am3PI_4",
    "amE",
    "amINVLN2",
    "amIVLN10",
    "amLN2",
    "amLN2HI",
    "amLN2LO",
    "amLN10",
    "amLOG2E",
    "amLOG2_E",
    "amLOG10E",
    "amPI",
    "amPI_2",
    "amPI_4",
    "amSQRT1_2",
    "amSQRT2",
    "amSQRT3",
    "amSQRTPI",
    "amTWOPI",
]

am2_SQRTPI: Final = 1.12838

amSQRT1_2: Final = 0.707107

amSQRTPI: Final = 1.77245

amLOG2_E: Final = 0.693147

amLOG10E: Final = 0.434294

amIVLN10: Final = 0.434294

amINVLN2: Final = 1.4427

amTWOPI: Final = 6.28319

amSQRT3: Final = 1.73205

amSQRT2: Final = 1.41421

amLOG2E: Final = 1.4427

amLN2LO: Final = 1.90821e-10

amLN2HI: Final = 0.693147

am3PI_4: Final = 2.35619

amPI_4: Final = 0.785398

amPI_2: Final = 1.5708

amLN10: Final = 2.30259

am2_PI: Final = 0.63662

am1_PI: Final = 0.31831

amLN2: Final = 0.693147

amPI: Final = 3.14159

amE: Final = 2.71828
