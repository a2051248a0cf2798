"""At which settings does the tank overflow, and what does the overflow switch save it from?

plcsim campaign programs/tank/campaigns/overflow.py
"""

from plcsim.campaign import Always, Campaign, Choice, Maximum, Sobol, TimeUntil, Uniform
from plcsim.campaign.variables import Scalar
from plcsim.testing import Plc

campaign = Campaign(
    variables={
        "control.setpoint": Uniform(5, 12, nominal=6),
        "plant.inflow": Uniform(0.1, 3, nominal=0.25),
        "switch": Choice("works", "stuck"),
        "noise_mm": Uniform(0, 500),
    },
    sampling=Sobol(256),
    require=[
        Always(
            "no water is spilled", lambda plc: -plc["plant.spilled"] or 10.0 - plc["plant.level"]
        )
    ],
    measure=[Maximum("plant.level"), TimeUntil("control.alarm_high")],
)


@campaign.scenario
def fill(plc: Plc, values: dict[str, Scalar]) -> dict[str, Scalar]:
    """Fill the tank for twenty seconds; the sensor is noisy, the overflow switch may be stuck."""
    if values["switch"] == "stuck":
        plc.faults.stuck("overflow_switch", value=False)
    if values["noise_mm"]:
        plc.faults.noise("level_raw", float(values["noise_mm"]) * 2.7648)
    plc.run("20s")
    return {"spilled_m3": plc["plant.spilled"]}
