"""The simulated robot of a vendor's URDF, with all joints that it has: those that the mechanism has too are driven, the
others held by servos.
"""

import mujoco
import numpy as np

from .robot import Robot
from .urdf_model import UrdfModel


class UrdfRobot(Robot):
    """A robot as its vendor's URDF describes it. The free joint carries the URDF's root link."""

    def _load(self, told):
        setup = told["urdf_setup"]
        self.urdf_joints = {joint["role"]: (joint["urdf"], float(joint["sign"])) for joint in setup["joints"]}
        if set(self.urdf_joints) != set(told["joints"]):
            raise ValueError("joints and urdf_setup.joints are not of the same joints")
        built = UrdfModel(told["urdf"], setup, self.step_s, is_plane=not told["floor"])
        self.pushable = {name: (built.model.body(body).id, centre) for name, (body, centre) in built.pushable.items()}
        if unknown := {push["body"] for push in told["pushes"]} - set(self.pushable):
            raise ValueError(f"a push acts on {', '.join(sorted(unknown))}, which this robot does not have")
        self.held = [(built.model.joint(each["urdf"]).qposadr[0], each["at"]) for each in setup["held"]]
        self.sole = built.model.site("right_sole").id
        self.foot = built.model.site_bodyid[self.sole]
        return built.spec, "right_foot_on_floor"

    def _joint(self, name):
        return self.urdf_joints[name]

    def _set_sole(self, start):
        model, data = self.model, self.data
        for qpos, angle in self.held:
            data.qpos[qpos] = angle
        # First the root rests at the world's origin, to see where the sole is and how it moves.
        data.qpos[0:7] = (0, 0, 0, 1, 0, 0, 0)
        data.qvel[0:6] = 0
        self._move()
        position, orientation, rate, velocity = self._sole_motion()
        back, root, turn = np.zeros(4), np.zeros(4), np.zeros(9)
        mujoco.mju_negQuat(back, orientation)
        mujoco.mju_mulQuat(root, np.array(start["orientation"], dtype=float), back)
        mujoco.mju_normalize4(root)
        mujoco.mju_quat2Mat(turn, root)
        turn = turn.reshape(3, 3)
        arm = turn @ position
        root_rate = np.array(start["angular_rate"]) - turn @ rate
        data.qpos[0:3] = np.array(start["position"]) - arm
        data.qpos[3:7] = root
        data.qvel[0:3] = np.array(start["velocity"]) - turn @ velocity - np.cross(root_rate, arm)
        data.qvel[3:6] = turn.T @ root_rate

    def _move(self):
        """Brings places and velocities of all bodies up to date."""
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_comVel(self.model, self.data)

    def _sole_motion(self):
        """Place, orientation, angular rate and velocity of the right sole, in world axes."""
        model, data = self.model, self.data
        orientation, motion = np.zeros(4), np.zeros(6)
        mujoco.mju_mulQuat(orientation, data.xquat[self.foot], model.site_quat[self.sole])
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_SITE, self.sole, motion, 0)
        return data.site_xpos[self.sole].copy(), orientation, motion[0:3], motion[3:6]

    def links(self):
        """Names of the links that can be pushed."""
        return list(self.pushable)

    def _pushed(self, name):
        body, local = self.pushable[name]
        return body, self.data.xpos[body] + self.data.xmat[body].reshape(3, 3) @ local

    def _sole_origin(self):
        return self.data.site_xpos[self.sole]

    def _tell_sole(self):
        self._move()
        state = self.state
        state[0:3], state[3:7], state[7:10], state[10:13] = self._sole_motion()
