"""Library AsBrMath as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import Final

__all__ = [
    "brm1_PI",
    "brm2_PI",
    "brm2_SQRTPI",
    "brm3PI_4",
    "brmE",
    "brmINVLN2",
    "brmIVLN10",
    "brmLN2",
    "brmLN2HI",
    "brmLN2LO",
    "brmLN10",
    "brmLOG2E",
    "brmLOG2_E",
    "brmLOG10E",
    "brmPI",
    "brmPI_2",
    "brmPI_4",
    "brmSQRT1_2",
    "brmSQRT2",
    "brmSQRT3",
    "brmSQRTPI",
    "brmTWOPI",
]

brm2_SQRTPI: Final = 1.12838

brmSQRT1_2: Final = 0.707107

brmSQRTPI: Final = 1.77245

brmLOG2_E: Final = 0.693147

brmLOG10E: Final = 0.434294

brmIVLN10: Final = 0.434294

brmINVLN2: Final = 1.4427

brmTWOPI: Final = 6.28319

brmSQRT3: Final = 1.73205

brmSQRT2: Final = 1.41421

brmLOG2E: Final = 1.4427

brmLN2LO: Final = 1.90821e-10

brmLN2HI: Final = 0.693147

brm3PI_4: Final = 2.35619

brmPI_4: Final = 0.785398

brmPI_2: Final = 1.5708

brmLN10: Final = 2.30259

brm2_PI: Final = 0.63662

brm1_PI: Final = 0.31831

brmLN2: Final = 0.693147

brmPI: Final = 3.14159

brmE: Final = 2.71828
