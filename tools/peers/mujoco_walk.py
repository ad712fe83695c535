"""MuJoCo's time for a step of 1 ms, walking: `python mujoco_walk.py PLAYED`, in an environment with MuJoCo.

PLAYED is what `survey accuracy --played` writes: places of a walk in MuJoCo, and the setpoints that follow each. They are
played in C; of each the least of some turns counts.
"""

import json
import sys
import time
from pathlib import Path

import mujoco
import numpy as np
from mujoco import rollout

sys.path.append(str(Path(__file__).resolve().parents[1] / "mujoco_plant"))
from plant import Robot  # noqa: E402

TURNS = 5


def main():
    """Plays, and prints how long a step took [ns]."""
    played = json.loads(Path(sys.argv[1]).read_text())
    robots = [Robot(place["told"]) for place in played]
    states = np.array([state(robot) for robot in robots])
    controls = np.array([control(robot, place["setpoints"]) for robot, place in zip(robots, played)])
    model, data = robots[0].model, mujoco.MjData(robots[0].model)
    assert model.opt.timestep == 0.001

    least = np.full(len(played), np.inf)
    with rollout.Rollout(nthread=0) as player:
        for _ in range(TURNS):
            for place in range(len(played)):
                begin = time.perf_counter()
                ends, _ = player.rollout(model, data, states[place], controls[place])
                least[place] = min(least[place], time.perf_counter() - begin)
                assert abs(ends[0, -1, 3]) < 0.2, f"a foot at a height of {ends[0, -1, 3]} m: the robot does not walk"
    print(json.dumps({"mujoco_walk": least.mean() / controls.shape[1] * 1e9}))


def state(robot):
    """Time, place, speed and all else that the next step depends on."""
    kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
    numbers = np.zeros(mujoco.mj_stateSize(robot.model, kind))
    mujoco.mj_getState(robot.model, robot.data, numbers, kind)
    return numbers


def control(robot, setpoints):
    """What `Robot.advance` gives the actuators, for all setpoints."""
    angles, rates, feed_forward = np.moveaxis(np.array(setpoints)[:, :, robot.powered], 1, 0)
    controls = np.zeros((len(setpoints), robot.model.nu))
    controls[:, robot.actuators] = robot.stiffness * angles + robot.damping * rates + feed_forward
    return controls


if __name__ == "__main__":
    main()
