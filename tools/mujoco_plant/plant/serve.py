"""Answers setpoints with states until there are no more."""

import contextlib
import json
import os
import sys
from xml.etree import ElementTree

import mujoco
import numpy as np

from .protocol import JOINTS, PROTOCOL, SETPOINT, STATE
from .robot import Robot
from .urdf_robot import UrdfRobot

# stdout, past Python's buffer: a state is less than what a pipe takes at once.
STATES = 1


def serve():
    """Reads the robot, then a setpoint per period."""
    told = json.loads(sys.stdin.buffer.readline())
    if told["protocol"] != PROTOCOL:
        sys.exit(f"halfstep speaks engine protocol {told['protocol']}, this MuJoCo plant {PROTOCOL}")
    try:
        robot = UrdfRobot(told) if "urdf" in told else Robot(told)
    except (ValueError, ElementTree.ParseError) as error:
        sys.exit(f"MuJoCo cannot load the robot: {error}")
    hello = {"protocol": PROTOCOL, "engine": f"MuJoCo {mujoco.__version__}", "setpoint": SETPOINT, "state": STATE}
    hello["links"] = robot.links()
    os.write(STATES, json.dumps(hello).encode() + b"\n")
    # Nobody left to answer is as good an end as no more setpoints.
    with contextlib.suppress(BrokenPipeError):
        while len(record := sys.stdin.buffer.read(8 * SETPOINT)) == 8 * SETPOINT:
            *setpoint, periods, change_bytes = np.frombuffer(record, "<f8")
            if change_bytes:
                robot.change(json.loads(sys.stdin.buffer.read(int(change_bytes))))
            robot.setpoint[:] = np.reshape(setpoint, (3, JOINTS))
            robot.advance(int(periods))
            os.write(STATES, robot.state.astype("<f8", copy=False).tobytes())
