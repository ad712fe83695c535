"""Operators ask, observers listen."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import iceoryx2 as iox2

from .destination import Footstep, Waypoint, write_destination
from .errors import HalfstepError, NoController, TimedOut
from .instance import Agreement, Instance
from .messages import Fault, Intent, Lifetime, Reason, Reply, Report, Request, Source, Verdict

_TURN, _SPEED, _EXTENSION, _INTENT, _SIDESTEP, _VELOCITY = 1, 2, 4, 8, 32, 64
_MARGIN, _FAULT, _ARRIVAL = 4, 8, 64
_GLANCE_S = 0.001


@dataclass(frozen=True)
class Answer:
    """What became of a request, and why."""

    verdict: Verdict
    reason: Reason
    effect_half_step: int
    """The half-step in which it takes effect."""
    turn: float
    """Granted [rad]."""
    speed: float
    """Granted."""
    extension: float
    """Granted [rad]."""
    sidestep: float
    """Granted [rad]."""
    step_ahead: float
    """How far ahead of the other foot each foot lands then [m]."""
    step_aside: float
    """How far a full step goes aside then [m]."""
    velocity: tuple[float, float, float]
    """The mean velocity then: ahead, left [m/s], turning to the left [rad/s]."""
    predicted_margin: float | None
    """Least distance of the zero-moment point to the sole's edge foreseen for what was granted [m]."""
    place: int | None
    """The way-point or footstep that the reason is about, counted from 1."""
    arrival: float | None
    """Foreseen time until the robot stands at its destination [s]."""
    latched: Fault | None
    """The fault that keeps the robot from walking until a reset, if there is one."""
    latched_at: float | None
    """When it was latched: time of the controller since its first tick [s]."""

    @property
    def accepted(self) -> bool:
        """Whether it takes effect as asked."""
        return self.verdict == Verdict.ACCEPTED


def answer(reply: Reply) -> Answer:
    """What a reply says."""
    return Answer(
        Verdict(reply.verdict),
        Reason(reply.reason),
        reply.effect_half_step,
        reply.turn,
        reply.speed,
        reply.extension,
        reply.sidestep,
        reply.step_ahead,
        reply.step_aside,
        (reply.velocity[0], reply.velocity[1], reply.velocity[2]),
        reply.predicted_margin if reply.known & _MARGIN else None,
        reply.place or None,
        reply.arrival if reply.known & _ARRIVAL else None,
        Fault(reply.fault) if reply.known & _FAULT else None,
        reply.fault_time if reply.known & _FAULT else None,
    )


class Operator:
    """Asks the controller of an instance."""

    def __init__(self, instance: Instance | str = "default") -> None:
        """Connects; without a controller `NoController`, with another version `Mismatch`."""
        self.instance = instance if isinstance(instance, Instance) else Instance(instance)
        agreement = Agreement(self.instance, "request", iox2.MessagingPattern.RequestResponse)
        with self.instance.turn():
            self._node = self.instance.join("operator")
            self._service = agreement.open(
                lambda: self._node.service_builder(agreement.name)
                .request_response(Request, Reply)
                .enable_safe_overflow_for_requests(False)
                .enable_safe_overflow_for_responses(False)
                .enable_fire_and_forget_requests(False)
                .open()
            )
            self._client = (
                self._service.client_builder().backpressure_strategy(iox2.BackpressureStrategy.DiscardData).create()
            )
            self.instance.take_room("operator")
        if not self.controller_is_there():
            raise NoController(f"no controller is running on instance {self.instance.name!r}")

    def controller_is_there(self) -> bool:
        """Whether a controller is alive."""
        self._service.try_cleanup_dead_nodes()
        return bool(self._service.dynamic_config.number_of_servers > 0)

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
        intent: Intent | None = None,
        not_before: int = 0,
        silence_s: float | None = None,
        timeout_s: float = 5.0,
    ) -> Answer:
        """Asks for a set that takes effect whole, and waits for the answer.

        Either gait parameters or a velocity, `vx` ahead and `vy` to the left [m/s] and `wz_deg_s` turning to the left [°/s];
        what is left out of a velocity is 0, and zero is a stand.

        Or a destination: `goto` is a goal, or way-points of which the last is the goal; `footsteps` are soles, right and
        left in turn; at most 24. They are in the walk frame (origin in the middle between the feet when the controller
        started, x ahead, y to the left), with `relative` seen from the robot. With a destination goes no gait parameter
        but speed, and no intent but to walk. The robot stands at the end: `Report.destination_places_left` is 0 then.
        Whatever else moves the robot cancels it.

        `not_before` is the controller's tick before which it must not take effect: 0 is at once. With `silence_s` this
        program is in command from now on, those after it are refused, and the walk comes to a stand when it asks nothing
        for that long; without, what is asked lasts until another request changes it. What the controller has not begun with
        after `timeout_s` expires: it is not carried out later.
        """
        velocity = (vx, vy, None if wz_deg_s is None else math.radians(wz_deg_s))
        is_velocity = any(part is not None for part in velocity)
        if is_velocity and any(value is not None for value in (turn_deg, speed, extension_deg, sidestep_deg)):
            raise ValueError("a velocity and gait parameters in one request: ask for either")
        expires_ns = time.monotonic_ns() + int(timeout_s * 1e9)
        request = Request(not_before=not_before, source=Source.PROGRAM, expires_ns=expires_ns)
        if silence_s is not None:
            request.lasting, request.age_limit = Lifetime.STREAMED, silence_s
        for bit, field, value in (
            (_TURN, "turn", turn_deg if turn_deg is None else math.radians(turn_deg)),
            (_SPEED, "speed", speed),
            (_EXTENSION, "extension", extension_deg if extension_deg is None else math.radians(extension_deg)),
            (_SIDESTEP, "sidestep", sidestep_deg if sidestep_deg is None else math.radians(sidestep_deg)),
            (_INTENT, "intent", intent),
        ):
            if value is not None:
                request.present |= bit
                setattr(request, field, value)
        if is_velocity:
            request.present |= _VELOCITY
            request.velocity[:] = [part or 0.0 for part in velocity]
        is_walk = not is_velocity and all(value is None for value in (turn_deg, extension_deg, sidestep_deg))
        if write_destination(request, goto, footsteps, relative) and not (is_walk and intent in (None, Intent.WALK)):
            raise ValueError("with a destination goes no gait parameter but speed, and no intent but to walk")
        return self._wait(self._client.send_copy(request), timeout_s)

    def _wait(self, pending: Any, timeout_s: float) -> Answer:
        began = time.monotonic()
        while True:
            connected = pending.is_connected
            response = pending.receive()
            if response is not None:
                reply = Reply.copy_of(response.payload().contents)
                response.delete()
                return answer(reply)
            if not connected:
                raise HalfstepError("the controller dropped the request, or left")
            if time.monotonic() - began > timeout_s:
                raise TimedOut(f"no answer within {timeout_s} s")
            time.sleep(_GLANCE_S)


class Observer:
    """Hears what the controller of an instance reports, once per period."""

    def __init__(self, instance: Instance | str = "default") -> None:
        """Connects; without a controller `NoController`, with another version `Mismatch`."""
        self.instance = instance if isinstance(instance, Instance) else Instance(instance)
        agreement = Agreement(self.instance, "report", iox2.MessagingPattern.PublishSubscribe)
        with self.instance.turn():
            self._node = self.instance.join("observer")
            service = agreement.open(
                lambda: self._node.service_builder(agreement.name).publish_subscribe(Report).open()
            )
            self._subscriber = service.subscriber_builder().create()
            self.instance.take_room("observer")

    def next_report(self) -> Report | None:
        """The oldest report that has not been read; `None` when there is no new one."""
        sample = self._subscriber.receive()
        if sample is None:
            return None
        report = Report.copy_of(sample.payload().contents)
        sample.delete()
        return report

    def newest(self) -> Report | None:
        """The last of the reports that have not been read; `None` when there is no new one."""
        newest = None
        while (report := self.next_report()) is not None:
            newest = report
        return newest

    def reports(self, silence_max_s: float = 1.0) -> Iterator[Report]:
        """Reports as they come, until none has come for so long."""
        heard = time.monotonic()
        while time.monotonic() - heard < silence_max_s:
            report = self.next_report()
            if report is None:
                time.sleep(_GLANCE_S)
            else:
                heard = time.monotonic()
                yield report
