"""The process answers as the class does."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np

import plant


def check_pipes(name, told):
    """Each state through the pipe is that of the class."""
    robot = plant.UrdfRobot(told)
    command = [sys.executable, "-I", str(Path(plant.__file__).parents[1])]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        process.stdin.write(json.dumps(told).encode() + b"\n")
        process.stdin.flush()
        hello = json.loads(process.stdout.readline())
        assert (hello["setpoint"], hello["state"]) == (plant.SETPOINT, plant.STATE), hello
        for period in range(5):
            robot.setpoint[0] = 0.001 * period
            robot.advance(period)
            process.stdin.write(np.append(robot.setpoint, [period, 0]).astype("<f8").tobytes())
            process.stdin.flush()
            state = np.frombuffer(process.stdout.read(8 * plant.STATE), "<f8")
            assert (state == robot.state).all(), f"{name}: another state through the pipe"
        process.stdin.close()
    assert process.returncode == 0, process.returncode
