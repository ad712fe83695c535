"""Requests and replies of walks in this process, in the words of `halfstep stream`."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from .destination import Footstep, Waypoint
from .errors import BadInput
from .messages import Intent, Verdict

_VERDICTS = {"accepted": Verdict.ACCEPTED, "limited": Verdict.LIMITED, "refused": Verdict.REFUSED}


@dataclass(frozen=True)
class WalkReply:
    """What became of a request, and why."""

    verdict: Verdict
    text: str
    """The reply in words, as `halfstep send` prints it."""
    granted: dict[str, Any] = field(repr=False)
    """The reply as `halfstep send --json` prints it: what is in force from then on, and the limit that was met."""

    @property
    def accepted(self) -> bool:
        """Whether it takes effect as asked."""
        return self.verdict == Verdict.ACCEPTED


def reply_of(text: str) -> WalkReply:
    """A reply as the compiled part tells it."""
    granted = json.loads(text)
    return WalkReply(_VERDICTS[granted["verdict"]], granted.pop("text"), granted)


def line_of(
    numbers: Mapping[str, float | None],
    intent: Intent | str | None,
    goto: Waypoint | Sequence[Waypoint] | None = None,
    footsteps: Sequence[Footstep] | None = None,
    relative: bool = False,
) -> str:
    """A request as a line of JSON; numbers by the names that `halfstep stream` has for them."""
    line: dict[str, Any] = {name: float(number) for name, number in numbers.items() if number is not None}
    for name, number in line.items():
        if not math.isfinite(number):
            raise BadInput(f"{name} = {number}: must be a finite number")
    if goto is not None:
        waypoints = [goto] if isinstance(goto, Waypoint) else goto
        line["goto"] = [_waypoint(waypoint) for waypoint in waypoints]
    if footsteps is not None:
        line["footsteps"] = [
            {"side": step.side.value, "x_m": step.x, "y_m": step.y, "heading_deg": step.heading_deg}
            for step in footsteps
        ]
    if relative:
        line["relative"] = True
    if intent is not None:
        line["intent"] = intent.name.lower().replace("_", "-") if isinstance(intent, Intent) else intent
    return json.dumps(line)


def _waypoint(place: Waypoint) -> dict[str, float]:
    written = {"x_m": place.x, "y_m": place.y}
    return written if place.heading_deg is None else {**written, "heading_deg": place.heading_deg}
