"""Destinations: way-points to a goal, or footsteps."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from .messages import Request

PLACES_MAX = 24
"""Most way-points or footsteps of a request."""

_DESTINATION = 128
_WAYPOINTS, _FOOTSTEPS = 0, 1
_WALK, _ROBOT = 0, 1


class Side(Enum):
    """Which foot."""

    RIGHT = "right"
    LEFT = "left"


@dataclass(frozen=True)
class Waypoint:
    """A pose of the middle between both soles, to walk through or to."""

    x: float
    """Along x [m]."""
    y: float
    """Along y [m]."""
    heading_deg: float | None = None
    """Positive to the left [°]; `None` is any."""


@dataclass(frozen=True)
class Footstep:
    """A foot and where its sole lands."""

    side: Side
    """Which foot."""
    x: float
    """Of the point under the ankle, along x [m]."""
    y: float
    """Along y [m]."""
    heading_deg: float
    """Of the sole, positive to the left [°]."""


def write_destination(
    request: Request,
    goto: Waypoint | Sequence[Waypoint] | None,
    footsteps: Sequence[Footstep] | None,
    relative: bool,
) -> bool:
    """Writes a destination into a request, and says whether there is one."""
    if goto is not None and footsteps is not None:
        raise ValueError("way-points and footsteps in one request: ask for either")
    if goto is None and footsteps is None:
        if relative:
            raise ValueError("relative without goto or footsteps")
        return False
    places: Sequence[Waypoint | Footstep]
    if footsteps is not None:
        places, request.place_kind = footsteps, _FOOTSTEPS
        marked = [step.side == Side.LEFT for step in footsteps]
    else:
        places = [goto] if isinstance(goto, Waypoint) else goto or []
        request.place_kind = _WAYPOINTS
        marked = [place.heading_deg is not None for place in places]
    if not 1 <= len(places) <= PLACES_MAX:
        raise ValueError(f"{len(places)} places: there must be 1 to {PLACES_MAX}")
    request.present |= _DESTINATION
    request.place_count = len(places)
    request.place_frame = _ROBOT if relative else _WALK
    request.place_marks = sum(1 << number for number, is_marked in enumerate(marked) if is_marked)
    for number, place in enumerate(places):
        heading = math.radians(place.heading_deg or 0.0)
        request.places[3 * number : 3 * number + 3] = [place.x, place.y, heading]
    return True
