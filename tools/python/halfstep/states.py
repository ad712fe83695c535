"""States of a walk: what the controller reports, and what is true of the simulated robot."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._halfstep import columns
from .messages import Mode

Floats = NDArray[np.float64]


def _places() -> dict[str, tuple[int, int]]:
    places, at = {}, 0
    for name, width in columns():
        places[name] = (at, width)
        at += width
    return places


_PLACES = _places()


class States:
    """One state, or many: a view on rows of numbers, without copies.

    Of `Walk.state` each property is a number or a vector, of `Walk.run` an array over time, of `Batch.states` an array
    over the walks. What is unknown is NaN: what the feet measure while both are in the air, what is reported before the
    first period. Units are metres, seconds, radians, newtons and amperes. Points "in support" are in the support foot's
    sole frame: origin under its ankle, x ahead, y to the left. The world has its origin where the right sole began,
    x ahead, y to the left, z up. Joints are in the order of `Joint`.
    """

    def __init__(self, rows: Floats) -> None:
        self.rows = rows
        """The numbers: the last axis are the columns."""

    def __len__(self) -> int:
        return len(self.rows) if self.rows.ndim > 1 else 1

    def __eq__(self, other: object) -> bool:
        """Whether all numbers are the same; what is unknown in both is."""
        return isinstance(other, States) and np.array_equal(self.rows, other.rows, equal_nan=True)

    __hash__ = None  # type: ignore[assignment]

    def __getitem__(self, place: Any) -> States:
        """Some of the states."""
        if self.rows.ndim < 2:
            raise IndexError("this is one state")
        return States(self.rows[place])

    def _get(self, name: str) -> Any:
        at, width = _PLACES[name]
        if width > 1:
            return self.rows[..., at : at + width]
        column = self.rows[..., at]
        return column if column.ndim else float(column)

    @property
    def time(self) -> Any:
        """Simulated time since the beginning [s]."""
        return self._get("time")

    @property
    def mode(self) -> Any:
        """What the controller is doing: a `Mode` of one state, numbers of `Mode` of many."""
        number = self._get("mode")
        if isinstance(number, float):
            return None if np.isnan(number) else Mode(int(number))
        return number

    @property
    def half_step(self) -> Any:
        """Half-steps completed."""
        return self._get("half_step")

    @property
    def support(self) -> Any:
        """The support foot: 0 is right, 1 is left."""
        return self._get("support")

    @property
    def progress(self) -> Any:
        """Progress of the half-step, 0 to 1."""
        return self._get("progress")

    @property
    def speed(self) -> Any:
        """Speed as a multiple of the nominal speed."""
        return self._get("speed")

    @property
    def margin(self) -> Any:
        """Distance of the measured zero-moment point to the edge of the support polygon, negative outside [m]."""
        return self._get("margin")

    @property
    def zmp_in_support(self) -> Floats:
        """Measured zero-moment point x, y [m]."""
        return self._get("zmp_in_support")  # type: ignore[no-any-return]

    @property
    def zmp_planned(self) -> Floats:
        """Zero-moment point of the commanded motion, likewise [m]."""
        return self._get("zmp_planned")  # type: ignore[no-any-return]

    @property
    def com_in_support(self) -> Floats:
        """Estimated centre of mass x, y, z [m]."""
        return self._get("com_in_support")  # type: ignore[no-any-return]

    @property
    def com_velocity_in_support(self) -> Floats:
        """Its velocity [m/s]."""
        return self._get("com_velocity_in_support")  # type: ignore[no-any-return]

    @property
    def capturability(self) -> Any:
        """What it takes to keep the robot from falling: numbers of `Capturability`."""
        return self._get("capturability")

    @property
    def estimated_pose(self) -> Floats:
        """Where odometry says that the robot is: x, y [m] and heading [rad], in the frame in which it began."""
        return self._get("estimated_pose")  # type: ignore[no-any-return]

    @property
    def estimated_velocity(self) -> Floats:
        """Mean velocity of the last full step: ahead, to the left [m/s], turning to the left [rad/s]."""
        return self._get("estimated_velocity")  # type: ignore[no-any-return]

    @property
    def faults(self) -> Any:
        """What is wrong: numbers of `Fault`."""
        return self._get("faults")

    @property
    def fallen(self) -> Any:
        """Whether the robot has fallen."""
        column = self._get("fallen")
        return bool(column) if isinstance(column, float) else column > 0

    @property
    def right_sole(self) -> Floats:
        """True pose of the right sole in the world: x, y, z [m] and a unit quaternion w, x, y, z."""
        return self._get("right_sole")  # type: ignore[no-any-return]

    @property
    def left_sole(self) -> Floats:
        """True pose of the left sole, likewise."""
        return self._get("left_sole")  # type: ignore[no-any-return]

    @property
    def loads(self) -> Floats:
        """True forces on the right and the left sole, normal to the floor [N]."""
        return self._get("loads")  # type: ignore[no-any-return]

    @property
    def com(self) -> Floats:
        """True centre of mass in the world [m]."""
        return self._get("com")  # type: ignore[no-any-return]

    @property
    def com_velocity(self) -> Floats:
        """Its velocity [m/s]."""
        return self._get("com_velocity")  # type: ignore[no-any-return]

    @property
    def zmp(self) -> Floats:
        """True zero-moment point x, y in the world [m]."""
        return self._get("zmp")  # type: ignore[no-any-return]

    @property
    def trunk_tilt(self) -> Any:
        """Angle of the trunk against the vertical [rad]."""
        return self._get("trunk_tilt")

    @property
    def angles(self) -> Floats:
        """True joint angles [rad]."""
        return self._get("angles")  # type: ignore[no-any-return]

    @property
    def rates(self) -> Floats:
        """True joint rates [rad/s]."""
        return self._get("rates")  # type: ignore[no-any-return]

    @property
    def asked_angles(self) -> Floats:
        """Joint angles of the setpoint [rad]."""
        return self._get("asked_angles")  # type: ignore[no-any-return]

    @property
    def asked_torques(self) -> Floats:
        """Feed-forward torques of the setpoint [N·m]."""
        return self._get("asked_torques")  # type: ignore[no-any-return]

    @property
    def measured_angles(self) -> Floats:
        """Joint angles as measured, with noise [rad]."""
        return self._get("measured_angles")  # type: ignore[no-any-return]

    @property
    def currents(self) -> Floats:
        """Currents of DC motors as measured [A]."""
        return self._get("currents")  # type: ignore[no-any-return]
