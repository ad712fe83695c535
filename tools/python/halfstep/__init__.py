"""Walk a biped from one nominal half-step.

In this process (`Walk`, and `Batch` for many at once):

    from halfstep import Walk
    walk = Walk("g1", seed=3)
    walk.ask(vx=0.3)
    print(walk.run(seconds=60).margin.min())

Or talk to one that runs: ask (`Operator`), listen (`Observer`), or be its robot (`Plant`):

    from halfstep import Operator
    print(Operator("default").ask(turn_deg=15, speed=1.2))
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .destination import Footstep, Side, Waypoint
from .errors import AlreadyRunning, BadInput, BadName, HalfstepError, Mismatch, NoController, TimedOut, Unstable
from .instance import Instance
from .messages import (
    PROTOCOL,
    Capturability,
    Fault,
    Intent,
    Joint,
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

if TYPE_CHECKING:
    from .asked import WalkReply
    from .states import States
    from .walk import Batch, Snapshot, Walk, robots

__all__ = [
    "PROTOCOL",
    "AlreadyRunning",
    "Answer",
    "BadInput",
    "BadName",
    "Batch",
    "Capturability",
    "Fault",
    "Footstep",
    "HalfstepError",
    "Instance",
    "Intent",
    "Joint",
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
    "Snapshot",
    "Source",
    "States",
    "TimedOut",
    "Unstable",
    "Verdict",
    "Walk",
    "WalkReply",
    "Waypoint",
    "robots",
    "stop",
]

_COMPILED = {"Batch": "walk", "Snapshot": "walk", "States": "states", "Walk": "walk", "WalkReply": "asked", "robots": "walk"}


def __getattr__(name: str) -> Any:
    """What needs the compiled part, which a checkout does not have before it is built: see `tools/python/wheel`."""
    if name not in _COMPILED:
        raise AttributeError(f"module 'halfstep' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f".{_COMPILED[name]}", __name__), name)
