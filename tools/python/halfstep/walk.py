"""Walks within this process: controller and simulated robot without shared memory, to the bits of `--lockstep`."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _halfstep
from ._halfstep import Snapshot
from .asked import WalkReply, line_of, reply_of
from .destination import Footstep, Waypoint
from .errors import BadInput
from .messages import Intent, Joint
from .states import States

Path = str | os.PathLike[str]

__all__ = ["Batch", "Snapshot", "Walk", "robots"]


def robots() -> list[str]:
    """Names of the robots in the box."""
    return _halfstep.robots()


class Walk:
    """A walk, period by period. It stands until it is asked to walk.

    The same arguments and calls give the same bits every time. Wrong values raise `BadInput` with file, key and remedy.
    """

    def __init__(
        self,
        robot: str | None = None,
        *,
        config: Path | None = None,
        urdf: Path | None = None,
        map: Path | None = None,
        seed: int = 0,
        from_stand: bool = True,
        rate_hz: int = 1000,
        parameters: Mapping[str, Any] | None = None,
        commands: Path | None = None,
        disturbances: Path | None = None,
    ) -> None:
        """Begins a walk.

        robot: name of a robot in the box (`robots()`); `config` a configuration folder instead, or `urdf` and, if need
            be, `map` of a biped that is imported. Without any of them it is the paper's robot.
        seed: of the sensors' noise and the mass errors.
        from_stand: whether the robot stands, or begins in stride as `halfstep walk` does.
        rate_hz: control periods per second.
        parameters: other values for keys of the configuration, such as `{"plant.contact.friction": 0.4}`.
        commands, disturbances: files as for `halfstep walk`.
        """
        self._walk = _halfstep.Walk(
            robot,
            config=config,
            urdf=urdf,
            map=map,
            seed=seed,
            from_stand=from_stand,
            rate_hz=rate_hz,
            parameters=None if parameters is None else dict(parameters),
            commands=commands,
            disturbances=disturbances,
        )

    def step(self, periods: int = 1) -> None:
        """Walks on by so many control periods. Raises `Unstable` if the simulation becomes so."""
        self._walk.step(periods)

    def run(self, seconds: float, every: float = 0.01) -> States:
        """Walks on and returns a state for every so many seconds, the end included. Both are whole periods."""
        every_periods = self._periods(every, "every")
        rows = self._periods(seconds, "seconds") // every_periods
        return States(self._walk.rows(rows, every_periods))

    def ask(
        self,
        *,
        turn_deg: float | None = None,
        speed: float | None = None,
        extension_deg: float | None = None,
        sidestep_deg: float | None = None,
        vx: float | None = None,
        vy: float | None = None,
        wz_deg_s: float | None = None,
        goto: Waypoint | Sequence[Waypoint] | None = None,
        footsteps: Sequence[Footstep] | None = None,
        relative: bool = False,
        intent: Intent | str | None = None,
    ) -> WalkReply:
        """Asks the controller, walks on until it has replied, and returns the reply.

        Mostly that is one period; a request late in a half-step may have to wait for the next one. What can be asked
        for is told at `Operator.ask`.
        """
        numbers = {
            "turn_deg": turn_deg,
            "speed": speed,
            "extension_deg": extension_deg,
            "sidestep_deg": sidestep_deg,
            "vx": vx,
            "vy": vy,
            "wz_deg_s": wz_deg_s,
        }
        return reply_of(self._walk.ask(line_of(numbers, intent, goto, footsteps, relative)))

    def push(self, impulse: ArrayLike, lasts: float = 0.1, link: str = "trunk") -> None:
        """Pushes a link from the next period on, by an impulse ahead, to the left and up [N·s] over some time [s]."""
        ahead, left, up = np.asarray(impulse, dtype=float)
        self._walk.push((ahead, left, up), lasts, link)

    def residual(self, angles: ArrayLike) -> None:
        """Adds an angle to each joint's setpoint [rad], from the next period on until it is set anew.

        Joints are in the order of `Joint`. At most 0.3 rad is added; a lag of 20 ms follows; the sum passes the limits of
        the joints.
        """
        self._walk.residual(np.asarray(angles, dtype=float).tolist())

    def reset(self, seed: int | None = None) -> None:
        """Begins anew, with another seed if one is given."""
        self._walk.reset(seed)

    def save(self) -> Snapshot:
        """The walk as it is now."""
        return self._walk.save()

    def restore(self, snapshot: Snapshot) -> None:
        """Goes back to how the walk was: from there it goes on to the same bits."""
        self._walk.restore(snapshot)

    @property
    def state(self) -> States:
        """The present state."""
        return States(self._walk.row())

    @property
    def tick(self) -> int:
        """Control periods walked."""
        return self._walk.tick

    @property
    def rate_hz(self) -> int:
        """Control periods per second."""
        return self._walk.rate_hz

    @property
    def seed(self) -> int:
        """The seed of noise and mass errors."""
        return self._walk.seed

    @property
    def setpoint_hash(self) -> str:
        """One number for all setpoints so far, as `halfstep walk --lockstep` prints it: the same one is the same bits."""
        return self._walk.setpoint_hash

    def _periods(self, seconds: float, name: str) -> int:
        periods = round(seconds * self.rate_hz) if math.isfinite(seconds) else 0
        if periods < 1:
            raise BadInput(f"{name} = {seconds}: must be at least a period, {1 / self.rate_hz} s")
        return periods


class Batch:
    """Many walks of one robot at once, on all cores, without Python's lock.

    Each has the bits of a `Walk` with its arguments. One whose simulation becomes unstable stops where it is; `ended`
    says why.
    """

    def __init__(
        self,
        robot: str | None = None,
        seeds: int | Sequence[int] = 1,
        *,
        config: Path | None = None,
        urdf: Path | None = None,
        map: Path | None = None,
        from_stand: bool = True,
        rate_hz: int = 1000,
        parameters: Mapping[str, Any] | Sequence[Mapping[str, Any]] | None = None,
        commands: Path | None = None,
        disturbances: Path | Sequence[Path | None] | None = None,
        threads: int | None = None,
    ) -> None:
        """Begins the walks.

        seeds: one for each walk, or the number of walks, whose seeds are then 0, 1, 2 and so on.
        parameters: other values for keys of the configuration: one mapping for all, or one for each walk.
        disturbances: a file for all, or one or `None` for each walk.
        threads: how many to use, by default as many as there are cores.

        The other arguments are those of `Walk`.
        """
        each_seed = list(range(seeds)) if isinstance(seeds, int) else [int(seed) for seed in seeds]
        if isinstance(parameters, Mapping):
            parameters = [parameters] * len(each_seed)
        if isinstance(disturbances, (str, os.PathLike)):
            disturbances = [disturbances] * len(each_seed)
        self._batch = _halfstep.Batch(
            robot,
            each_seed,
            config=config,
            urdf=urdf,
            map=map,
            from_stand=from_stand,
            rate_hz=rate_hz,
            parameters=None if parameters is None else [dict(each) for each in parameters],
            commands=commands,
            disturbances=None if disturbances is None else list(disturbances),
            threads=threads,
        )

    def __len__(self) -> int:
        return len(self._batch)

    def step(self, periods: int = 1) -> None:
        """All walk on by so many control periods."""
        self._batch.step(periods)

    def ask(
        self,
        *,
        which: ArrayLike | None = None,
        turn_deg: ArrayLike | None = None,
        speed: ArrayLike | None = None,
        extension_deg: ArrayLike | None = None,
        sidestep_deg: ArrayLike | None = None,
        vx: ArrayLike | None = None,
        vy: ArrayLike | None = None,
        wz_deg_s: ArrayLike | None = None,
        intent: Intent | str | None = None,
    ) -> None:
        """Asks the walks, from the next period on; each number for all, or one for each walk.

        which: flags of the walks that are asked; all of them without.

        Replies are in `replies` once the walks have gone on.
        """
        given = {
            "turn_deg": turn_deg,
            "speed": speed,
            "extension_deg": extension_deg,
            "sidestep_deg": sidestep_deg,
            "vx": vx,
            "vy": vy,
            "wz_deg_s": wz_deg_s,
        }
        each = {name: self._each(number, float) for name, number in given.items() if number is not None}
        asked = self._each(True if which is None else which, bool)
        lines = (
            line_of({name: numbers[place] for name, numbers in each.items()}, intent) for place in range(len(self))
        )
        self._batch.ask([line if is_asked else None for line, is_asked in zip(lines, asked, strict=True)])

    def push(self, impulses: ArrayLike, lasts: float = 0.1, link: str = "trunk") -> None:
        """Pushes a link of each walk: impulses ahead, to the left and up [N·s], one row each; zeros are no push."""
        each = np.broadcast_to(np.asarray(impulses, dtype=float), (len(self), 3))
        self._batch.push(np.ascontiguousarray(each), lasts, link)

    def residuals(self, angles: ArrayLike) -> None:
        """Adds an angle to each joint's setpoint of each walk [rad], one row each, until they are set anew."""
        each = np.broadcast_to(np.asarray(angles, dtype=float), (len(self), len(Joint)))
        self._batch.residuals(np.ascontiguousarray(each))

    def reset(self, which: ArrayLike | None = None, seeds: ArrayLike | None = None) -> None:
        """Begins walks anew: those that are flagged, or all; with other seeds if they are given, one for each walk."""
        chosen = self._each(True if which is None else which, bool)
        new = None if seeds is None else self._each(seeds, np.uint64)
        for place in np.flatnonzero(chosen):
            self._batch.reset_one(int(place), None if new is None else int(new[place]))

    def save(self, place: int) -> Snapshot:
        """One of the walks as it is now."""
        return self._batch.save(place)

    def restore(self, place: int, snapshot: Snapshot) -> None:
        """One of the walks goes on from there, to the same bits."""
        self._batch.restore(place, snapshot)

    @property
    def states(self) -> States:
        """The present states, one for each walk."""
        return States(self._batch.rows())

    @property
    def replies(self) -> list[WalkReply | None]:
        """The replies to the newest requests; `None` where there is none yet."""
        return [None if reply is None else reply_of(reply) for reply in self._batch.replies()]

    @property
    def ended(self) -> list[str | None]:
        """Why walks are at their end, where they are."""
        return self._batch.ended

    @property
    def seeds(self) -> list[int]:
        """The seeds."""
        return self._batch.seeds

    @property
    def rate_hz(self) -> int | None:
        """Control periods per second; `None` without any walk."""
        return self._batch.rate_hz

    @property
    def setpoint_hashes(self) -> list[str]:
        """For each walk, one number for all its setpoints so far."""
        return self._batch.setpoint_hashes

    def _each(self, value: ArrayLike, kind: Any) -> Any:
        return np.broadcast_to(np.asarray(value, kind), len(self))
