"""The robot's physics by MuJoCo, for `halfstep plant --engine mujoco`.

`halfstep` keeps the services, the clock, the sensors and the log; this process only moves the robot. `serve` talks to
it in the words of `protocol`, with one of two robots: `Robot` is a complete model of the twenty-joint mechanism,
`UrdfRobot` one of a vendor's URDF.
"""

from .protocol import JOINTS, POWERED, PROTOCOL, SETPOINT, SIDES, STATE
from .robot import Robot
from .urdf_robot import UrdfRobot

__all__ = ["JOINTS", "POWERED", "PROTOCOL", "SETPOINT", "SIDES", "STATE", "Robot", "UrdfRobot"]
