"""A plant: hears setpoints and tells measurements. For robots of your own."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Iterator
from typing import Any

import iceoryx2 as iox2

from .errors import AlreadyRunning, TimedOut
from .instance import Agreement, Instance
from .message import Message
from .messages import Measurement, Setpoint

_NOTHING_YET = 2**64 - 1
# As in `crates/wire/src/newest.rs`: a killed writer's place is taken for ever, so there are several.
_SLOTS = 64
_MAX_READERS, _MAX_NODES = 16, 24
_GLANCE_S = 0.0002
_LEAVING_S = 1.0
# Waking up costs more than a whole turn in lockstep.
_SPIN_S = 0.002


class _Newest:
    """A service of which only the newest message counts."""

    def __init__(
        self, instance: Instance, node: Any, service: str, message: type[Message], *terms: Any
    ) -> None:
        self.message = message
        self.agreement = agreement = Agreement(instance, service, iox2.MessagingPattern.Blackboard, *terms)

        def create() -> Any:
            creator = node.service_builder(agreement.name).blackboard_creator(ctypes.c_uint64)
            for slot in range(_SLOTS + 1):
                creator = creator.add(ctypes.c_uint64(slot), message(tick=_NOTHING_YET))
            creator = creator.max_readers(_MAX_READERS).max_nodes(_MAX_NODES)
            return creator.create_with_attributes(agreement.specifier())

        self.blackboard = agreement.open_or_create(
            lambda: node.service_builder(agreement.name).blackboard_opener(ctypes.c_uint64).open(), create
        )


class _Writer(_Newest):
    def take(self, role: str) -> None:
        """Becomes the one writer. A process that is just leaving may stand in the way for a while."""
        began = time.monotonic()
        while True:
            try:
                self._port = self.blackboard.writer_builder().create()
                break
            except Exception as cause:  # iceoryx2 has one error type per operation
                if time.monotonic() - began > _LEAVING_S:
                    raise AlreadyRunning(f"another {role} is already running, or cannot be removed: {cause!r}") from cause
            time.sleep(_SPIN_S)
        for slot in range(_SLOTS):
            try:
                self._entry = self._port.entry(ctypes.c_uint64(slot), self.message)
                return
            except Exception:  # its writer was killed
                continue
        raise AlreadyRunning(f"{_SLOTS} writers of this instance were killed; restart both sides")

    def write(self, message: Message) -> None:
        """Replaces the newest message."""
        self._entry.update_with_copy(message)


class _Reader(_Newest):
    def take(self) -> None:
        """Becomes a reader."""
        self._port = self.blackboard.reader_builder().create()
        self._slots = [self._port.entry(ctypes.c_uint64(slot), self.message) for slot in range(_SLOTS)]
        self._untouched = self._port.entry(ctypes.c_uint64(_SLOTS), self.message).get()
        self._current = 0

    def newest(self) -> Any:
        """The newest message, read before or not; `None` as long as none was written."""
        # Writers take the first free place: the highest one that was written is the last.
        for slot in range(_SLOTS - 1, self._current, -1):
            if not self._slots[slot].is_up_to_date(self._untouched):
                self._current = slot
                break
        message = self._slots[self._current].get().decode_as(self.message)
        return None if message.tick == _NOTHING_YET else message


class Plant:
    """The robot of an instance, for the mechanism with this fingerprint (`halfstep check` prints it)."""

    def __init__(
        self,
        mechanism: int,
        instance: Instance | str = "default",
        rate_hz: int = 1000,
        lockstep: bool = False,
        from_stand: bool = False,
    ) -> None:
        """Connects; when another plant is there `AlreadyRunning`, with another robot, version or option `Mismatch`.

        `rate_hz` is that of the controller's `realtime.toml`, `lockstep` and `from_stand` are its options.
        """
        self.instance = instance if isinstance(instance, Instance) else Instance(instance)
        terms = (mechanism, rate_hz, "lockstep" if lockstep else "realtime", "stand" if from_stand else "stride")
        with self.instance.turn(create=True):
            self._node = self.instance.join("plant")
            self._setpoints = _Reader(self.instance, self._node, "setpoint", Setpoint, *terms)
            self._measurements = _Writer(self.instance, self._node, "measurement", Measurement, *terms)
            self._setpoints.take()
            if self._setpoints.newest() is None:
                self._setpoints.agreement.check_start(self._setpoints.blackboard)
            self._measurements.take("plant")
            self.instance.take_room("plant")

    def setpoint(self) -> Setpoint | None:
        """The newest setpoint; `None` as long as there is none."""
        setpoint: Setpoint | None = self._setpoints.newest()
        return setpoint

    def write(self, measurement: Measurement) -> None:
        """Tells what the sensors say, and when."""
        measurement.time_ns = time.monotonic_ns()
        self._measurements.write(measurement)

    def lockstep(self, first: Measurement, ticks: int, silence_max_s: float = 30.0) -> Iterator[tuple[Setpoint, Measurement]]:
        """Tick for tick with the controller: yields its setpoint and the measurement to fill in, which is then written.

        The measurement begins as the one before, with its `tick` and `sample` counted on.
        """
        measurement = Measurement.copy_of(first)
        measurement.tick = measurement.sample = 0
        self.write(measurement)
        for tick in range(ticks):
            setpoint = self._wait_for(tick, silence_max_s)
            measurement.tick = measurement.sample = tick + 1
            yield setpoint, measurement
            self.write(measurement)

    def _wait_for(self, tick: int, silence_max_s: float) -> Setpoint:
        began = time.monotonic()
        while True:
            setpoint = self.setpoint()
            if setpoint is not None and setpoint.tick == tick:
                return setpoint
            waited = time.monotonic() - began
            if waited > silence_max_s:
                raise TimedOut(f"the controller's tick {tick} did not come within {silence_max_s} s")
            if waited > _SPIN_S:
                time.sleep(_GLANCE_S)
