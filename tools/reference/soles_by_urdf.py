"""Whether the soles of an imported robot are where the plan has them, by the URDF's own kinematics in MuJoCo.

    python tools/reference/soles_by_urdf.py DIR

`DIR` is a folder that `halfstep import` wrote. For each row of the nominal half-step the joints of the URDF get the
angles of the table, held joints theirs, and MuJoCo, which knows nothing of our mechanism, places the links. The plan has
the right sole level at O, and the left one level at both ends of the half-step, a step length behind and ahead. Prints
the largest deviations between the left sole by MuJoCo and by the mechanism file, in mm and degrees.
"""

import csv
import json
import math
import sys
import tomllib
from pathlib import Path

import mujoco
import numpy as np


def main():
    """Reads, places, prints."""
    folder = Path(sys.argv[1])
    mechanism = tomllib.loads((folder / "mechanism.toml").read_text())
    rows = [line for line in (folder / "nominal_half_step.csv").read_text().splitlines() if not line.startswith("#")]
    model = mujoco.MjSpec.from_string((folder / "robot.urdf").read_text()).compile()
    urdf = Urdf(model, mechanism)
    millimetres = degrees = level = 0.0
    for row in csv.DictReader(rows):
        angles = {
            name: float(row[f"joint_{joint['number']:02}_angle_rad"]) for name, joint in mechanism["joint"].items()
        }
        rotation, place = urdf.left_sole(angles)
        planned_rotation, planned = left_sole(mechanism["joint"], angles)
        millimetres = max(millimetres, 1e3 * float(np.linalg.norm(place - planned)))
        degrees = max(degrees, turn(rotation.T @ planned_rotation))
        level = max(level, math.degrees(math.acos(min(1.0, rotation[2, 2]))))
    print(json.dumps({"off_mm": millimetres, "off_deg": degrees, "tilt_deg": level}))


class Urdf:
    """The URDF's own kinematics."""

    def __init__(self, model, mechanism):
        self.model, self.data = model, mujoco.MjData(model)
        self.joints = {name: joint for name, joint in mechanism["joint"].items() if "urdf" in joint}
        self.held = {held["urdf"]: math.radians(held["at_deg"]) for held in mechanism.get("held", [])}
        source = mechanism["source"]
        turned = np.zeros(9)
        mujoco.mju_quat2Mat(turned, np.array(source["root_to_stand_wxyz"], float))
        self.root_to_stand = turned.reshape(3, 3)
        self._place({name: 0.0 for name in self.joints})
        # Where the soles are in the links that carry them, in the standing posture.
        self.feet = {}
        for side in ("right", "left"):
            body = self._foot(side)
            to_body = self._rotation(body).T
            sole = to_body @ (np.array(source[f"{side}_sole_m"], float) - self.data.xpos[body])
            self.feet[side] = body, sole, to_body @ self.root_to_stand.T

    def left_sole(self, angles):
        """Rotation and place (m) of the left sole, seen from the right one."""
        self._place(angles)
        poses = {}
        for side, (body, sole, turned) in self.feet.items():
            rotation = self._rotation(body)
            poses[side] = rotation @ turned, self.data.xpos[body] + rotation @ sole
        (right, origin), (left, place) = poses["right"], poses["left"]
        return right.T @ left, right.T @ (place - origin)

    def _place(self, angles):
        told = dict(self.held)
        told |= {joint["urdf"]: joint["urdf_sign"] * angles[name] for name, joint in self.joints.items()}
        for name, angle in told.items():
            self.data.qpos[self.model.joint(name).qposadr[0]] = angle
        mujoco.mj_kinematics(self.model, self.data)

    def _foot(self, side):
        """The body of the ankle joint that is further from the root."""
        ankles = [joint["urdf"] for name, joint in self.joints.items() if name.startswith(f"{side}_ankle")]
        bodies = [int(self.model.joint(name).bodyid[0]) for name in ankles]
        return max(bodies, key=self._depth)

    def _depth(self, body):
        return 0 if body == 0 else 1 + self._depth(int(self.model.body_parentid[body]))

    def _rotation(self, body):
        return self.data.xmat[body].reshape(3, 3)


def left_sole(joints, angles):
    """Rotation and place (m) of the left sole by the mechanism file, which stands on its right sole."""
    links = {"ground": (np.eye(3), np.zeros(3))}
    while len(links) <= len(joints):
        for name, joint in joints.items():
            if name not in links and joint["parent"] in links:
                rotation, place = links[joint["parent"]]
                turned = about(np.array(joint["axis"], float), angles[name])
                links[name] = rotation @ turned, place + rotation @ np.array(joint["origin_m"], float)
    parents = {joint["parent"] for joint in joints.values()}
    foot = next(name for name in joints if name.startswith("left_ankle") and name not in parents)
    first = next(joint for joint in joints.values() if joint["parent"] == "foot_pitch")
    ahead, left, up = (float(value) for value in first["origin_m"])
    rotation, place = links[foot]
    return rotation, place + rotation @ np.array([-ahead, left, -up])


def about(axis, angle):
    """The rotation by an angle (rad) about an axis."""
    across = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + math.sin(angle) * across + (1 - math.cos(angle)) * across @ across


def turn(rotation):
    """The angle of a rotation (deg)."""
    return math.degrees(math.acos(max(-1.0, min(1.0, (np.trace(rotation) - 1) / 2))))


if __name__ == "__main__":
    main()
