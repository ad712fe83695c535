"""Talk to a running Halfstep: ask (`Operator`), listen (`Observer`), or be its robot (`Plant`).

    from halfstep import Operator
    print(Operator("default").ask(turn_deg=15, speed=1.2))
"""

from .destination import Footstep, Side, Waypoint
from .errors import AlreadyRunning, BadName, HalfstepError, Mismatch, NoController, TimedOut
from .instance import Instance
from .messages import (
    PROTOCOL,
    Capturability,
    Fault,
    Intent,
    Measurement,
    Mode,
    Reason,
    Reply,
    Report,
    Request,
    SensorGroup,
    Setpoint,
    Source,
    Verdict,
)
from .operator import Answer, Observer, Operator
from .plant import Plant
from .urgent import stop

__all__ = [
    "PROTOCOL",
    "AlreadyRunning",
    "Answer",
    "BadName",
    "Capturability",
    "Fault",
    "Footstep",
    "HalfstepError",
    "Instance",
    "Intent",
    "Measurement",
    "Mismatch",
    "Mode",
    "NoController",
    "Observer",
    "Operator",
    "Plant",
    "Reason",
    "Reply",
    "Report",
    "Request",
    "SensorGroup",
    "Setpoint",
    "Side",
    "Source",
    "TimedOut",
    "Verdict",
    "Waypoint",
    "stop",
]
