"""The simulated robot of a complete MJCF model, with its drives.

The drives are those of `plant::Drive`: a position servo evaluated at the end of the integration step, with the back-EMF
compensated as far as the voltage goes. In MuJoCo's terms, with stiffness k, damping d, step h, back-EMF e:

    force of the actuator = clamp(k (target - q) + d (rate - q') + feed forward - h k q' + e q', +-torque at full voltage)
    damping of the joint  = e

of which `implicitfast` takes the derivative by q', as ours does.
"""

import mujoco
import numpy as np

from .floor import Floor
from .protocol import JOINTS, POWERED, SIDES, STATE


class Robot:
    """The simulated robot, one control period at a time."""

    def __init__(self, told):
        self.steps = told["steps_per_period"]
        self.period_s = told["period_s"]
        self.step_s = self.period_s / self.steps
        self.spec, sole = self._load(told)
        self.spec.option.timestep = self.step_s
        self.floor = Floor(self.spec, sole)
        self.floor.lay(told["floor"])
        self.model = self.spec.compile()
        self.data = mujoco.MjData(self.model)
        self.pushes = told["pushes"]

        names = [self._joint(name) for name in told["joints"]]
        powered = [self.model.joint(name) for name, _ in names]
        self.qpos = np.array([joint.qposadr[0] for joint in powered])
        self.dofs = np.array([joint.dofadr[0] for joint in powered])
        self.actuators = np.array([self.model.actuator(name).id for name, _ in names])
        self.powered = np.array([JOINTS - len(POWERED) + POWERED.index(name) for name in told["joints"]])
        # Where the model's joint turns the other way, -1.
        self.signs = np.array([sign for _, sign in names])
        self.stiffness, self.damping, self.back_emf = (
            np.array(told[key]) for key in ("stiffness", "damping", "back_emf")
        )
        self._set_drives()
        self._set_state(told["start"])

        self.setpoint = np.zeros((3, JOINTS))
        self.state = np.zeros(STATE)
        self.grounds = [self.model.sensor(f"{side}_ground").adr[0] for side in SIDES]

    def _load(self, told):
        """The robot, and the name of one of its soles."""
        return mujoco.MjSpec.from_string(told["mjcf"]), "right_foot"

    def change(self, change):
        """Goes on with another floor under the robot, with more pushes, or both."""
        if (bodies := change.get("floor")) is not None:
            self.lay_floor(bodies)
        self.pushes += change["pushes"]

    def lay_floor(self, bodies):
        """Goes on with another floor under the robot."""
        self.floor.lay(bodies)
        warm_start = self.data.qacc_warmstart.copy()
        self.model, self.data = self.spec.recompile(self.model, self.data)
        self.data.qacc_warmstart[:] = warm_start
        self._set_drives()

    def _joint(self, name):
        """What the model calls one of the twenty joints, and 1, or -1 if it turns the other way."""
        return name, 1.0

    def _set_drives(self):
        """Turns torque motors into drives."""
        bias = self.model.actuator_biasprm
        self.model.actuator_biastype[self.actuators] = mujoco.mjtBias.mjBIAS_AFFINE
        bias[self.actuators, 1] = -self.stiffness
        bias[self.actuators, 2] = -(self.damping + self.step_s * self.stiffness) + self.back_emf
        self.model.dof_damping[self.dofs] += self.back_emf

    def _set_state(self, start):
        self.data.qpos[self.qpos] = self.signs * np.array(start["angles"])[self.powered]
        self.data.qvel[self.dofs] = self.signs * np.array(start["rates"])[self.powered]
        self._set_sole(start)
        mujoco.mj_forward(self.model, self.data)

    def _set_sole(self, start):
        """Gives the right sole its place and velocity. Here it is what the free joint carries."""
        data = self.data
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, np.array(start["orientation"]))
        data.qpos[0:3] = start["position"]
        data.qpos[3:7] = start["orientation"]
        data.qvel[0:3] = start["velocity"]
        data.qvel[3:6] = rotation.reshape(3, 3).T @ start["angular_rate"]

    def advance(self, periods):
        """Moves on by one control period, after `periods` others, towards `setpoint`, and fills `state`.

        The plant's time goes on where the robot is held, too, and nothing is simulated here.
        """
        angles, rates, feed_forward = self.setpoint[:, self.powered]
        data = self.data
        for number in range(self.steps):
            lead = (self.steps - 1 - number) * self.step_s
            target = angles - lead * rates
            data.ctrl[self.actuators] = self.signs * (self.stiffness * target + self.damping * rates + feed_forward)
            if self.pushes:
                self._push(*(self._time(periods * self.steps + step) for step in (number, number + 1)))
            mujoco.mj_step(self.model, data)
        self._tell()

    def _time(self, step):
        """When an integration step begins (s), in the bits of `plant::Plant::time` where a period begins."""
        return step / self.steps * self.period_s

    def _push(self, start, end):
        """The mean force over a step, on the link's centre of mass, as `plant::Push::force_over`."""
        data = self.data
        data.qfrc_applied[:] = 0
        for push in self.pushes:
            covered = min(end, push["start"] + push["duration"]) - max(start, push["start"])
            if covered > 0:
                force = np.array(push["impulse"]) * (covered / (push["duration"] * (end - start)))
                body, point = self._pushed(push["body"])
                mujoco.mj_applyFT(self.model, data, force, np.zeros(3), point, body, data.qfrc_applied)

    def links(self):
        """Names of the links that can be pushed: those with a mass of their own."""
        model = self.model
        return [model.body(number).name for number in range(1, model.nbody) if model.body_mass[number] > 0]

    def _pushed(self, name):
        """The body of a link, and the link's centre of mass in the world."""
        body = self.model.body(name).id
        return body, self.data.xipos[body]

    def _tell(self):
        data, state = self.data, self.state
        state[13:33][self.powered] = self.signs * data.qpos[self.qpos]
        state[33:53][self.powered] = self.signs * data.qvel[self.dofs]
        origin = self._sole_origin()
        for place, sensor in zip((53, 59), self.grounds):
            force, moment, point = data.sensordata[sensor : sensor + 9].reshape(3, 3)
            # The sensor's point and the right sole's place are both of the step's beginning.
            state[place : place + 3] = force
            state[place + 3 : place + 6] = moment + np.cross(point - origin, force)
        torques = data.qfrc_actuator[self.dofs] - self.back_emf * data.qvel[self.dofs]
        state[65:85][self.powered] = self.signs * torques
        self._tell_sole()

    def _sole_origin(self):
        """The right sole's origin, as of the beginning of the last step."""
        return self.data.xpos[1]

    def _tell_sole(self):
        data, state = self.data, self.state
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, data.qpos[3:7])
        state[0:7] = data.qpos[0:7]
        state[7:10] = rotation.reshape(3, 3) @ data.qvel[3:6]
        state[10:13] = data.qvel[0:3]
