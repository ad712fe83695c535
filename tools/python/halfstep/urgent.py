"""A stop that needs neither shared memory nor a place among the operators: through a socket in the instance's folder."""

from __future__ import annotations

import os
import socket
import struct

from .errors import HalfstepError, Mismatch, NoController, TimedOut
from .instance import Instance
from .messages import PROTOCOL, Intent, Reply, Request, Source
from .operator import Answer, answer

_INTENT = 8
_HEAD = struct.Struct("<I")


def stop(instance: Instance | str = "default", intent: Intent = Intent.STOP, timeout_s: float = 2.0) -> Answer:
    """Stops the robot, with feet side by side (`Intent.STOP`) or in stride (`Intent.HOLD`), and waits for the answer.

    It gets through when all operators' places are taken and when shared memory is full. Without a controller
    `NoController`.
    """
    if intent not in (Intent.STOP, Intent.HOLD):
        raise ValueError(f"{intent!r} is no stop; ask an Operator")
    instance = instance if isinstance(instance, Instance) else Instance(instance)
    request = Request(source=Source.PROGRAM, present=_INTENT, intent=intent)
    try:
        folder = os.open(instance.root, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
    except FileNotFoundError as cause:
        raise NoController(f"no controller is running on instance {instance.name!r}") from cause
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as own:
            own.settimeout(timeout_s)
            # A name of its own, to which the answer can be sent.
            own.bind("")
            # Through the opened folder: its own path may be too long for a socket.
            own.connect(f"/proc/self/fd/{folder}/urgent")
            own.send(_HEAD.pack(PROTOCOL) + bytes(request))
            received = own.recv(1024)
    except TimeoutError as cause:
        raise TimedOut(f"no answer within {timeout_s} s") from cause
    except (FileNotFoundError, ConnectionError) as cause:
        raise NoController(f"no controller is running on instance {instance.name!r}") from cause
    finally:
        os.close(folder)
    (protocol,) = _HEAD.unpack_from(received)
    if protocol != PROTOCOL:
        raise Mismatch(f"this package has the protocol {PROTOCOL}, the controller {protocol}")
    try:
        return answer(Reply.from_buffer_copy(received, _HEAD.size))
    except ValueError as cause:
        raise HalfstepError(f"the answer is none: {cause}") from cause
