"""The robot's physics by MuJoCo, for `halfstep plant --engine mujoco`.

`halfstep` keeps the services, the clock, the sensors and the log; this process only moves the robot. They talk through
stdin and stdout:

1. `halfstep` writes one line of JSON (see `Robot.__init__`), this process answers with one (`hello`).
2. Then, per control period, `halfstep` writes a setpoint and this process answers with a state: little-endian doubles,
   laid out as in `SETPOINT` and `STATE`. When stdin ends, so does this process.

The drives are those of `plant::Drive`: a position servo evaluated at the end of the integration step, with the back-EMF
compensated as far as the voltage goes. In MuJoCo's terms, with stiffness k, damping d, step h, back-EMF e:

    force of the actuator = clamp(k (target - q) + d (rate - q') + feed forward - h k q' + e q', +-torque at full voltage)
    damping of the joint  = e

of which `implicitfast` takes the derivative by q', as ours does.
"""

import contextlib
import json
import os
import sys

import mujoco
import numpy as np

PROTOCOL = 1
# stdout, past Python's buffer: a state is less than what a pipe takes at once.
STATES = 1
JOINTS = 20
# angles, rates, feed-forward torques
SETPOINT = 3 * JOINTS
# right sole: place, quaternion w x y z, angular rate, velocity; angles, rates; ground's force and moment on the right
# and on the left foot, about the right sole's origin; motor torques. All but the joints' in world axes.
STATE = 3 + 4 + 3 + 3 + 2 * JOINTS + 2 * 6 + JOINTS


class Robot:
    """The simulated robot, one control period at a time."""

    def __init__(self, told):
        self.model = mujoco.MjModel.from_xml_string(told["mjcf"])
        self.data = mujoco.MjData(self.model)
        self.steps = told["steps_per_period"]
        self.step_s = told["period_s"] / self.steps
        self.model.opt.timestep = self.step_s
        self.pushes = told["pushes"]
        self.periods = 0

        powered = [self.model.joint(name) for name in told["joints"]]
        self.qpos = np.array([joint.qposadr[0] for joint in powered])
        self.dofs = np.array([joint.dofadr[0] for joint in powered])
        self.actuators = np.array([self.model.actuator(name).id for name in told["joints"]])
        self.powered = slice(JOINTS - len(powered), JOINTS)
        self._set_drives(told)
        self._set_state(told["start"])

        self.setpoint = np.zeros((3, JOINTS))
        self.state = np.zeros(STATE)
        self.grounds = [self.model.sensor(f"{side}_ground").adr[0] for side in ("right", "left")]

    def _set_drives(self, told):
        """Turns torque motors into drives."""
        stiffness, damping, back_emf = (np.array(told[key]) for key in ("stiffness", "damping", "back_emf"))
        self.stiffness, self.damping = stiffness, damping
        bias = self.model.actuator_biasprm
        self.model.actuator_biastype[self.actuators] = mujoco.mjtBias.mjBIAS_AFFINE
        bias[self.actuators, 1] = -stiffness
        bias[self.actuators, 2] = -(damping + self.step_s * stiffness) + back_emf
        self.model.dof_damping[self.dofs] = back_emf
        self.back_emf = back_emf

    def _set_state(self, start):
        data = self.data
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, np.array(start["orientation"]))
        data.qpos[0:3] = start["position"]
        data.qpos[3:7] = start["orientation"]
        data.qvel[0:3] = start["velocity"]
        data.qvel[3:6] = rotation.reshape(3, 3).T @ start["angular_rate"]
        data.qpos[self.qpos] = start["angles"][self.powered]
        data.qvel[self.dofs] = start["rates"][self.powered]
        mujoco.mj_forward(self.model, data)

    def advance(self):
        """Moves on by one control period towards `setpoint`, and fills `state`."""
        angles, rates, feed_forward = self.setpoint[:, self.powered]
        data = self.data
        for number in range(self.steps):
            lead = (self.steps - 1 - number) * self.step_s
            target = angles - lead * rates
            data.ctrl[self.actuators] = self.stiffness * target + self.damping * rates + feed_forward
            if self.pushes:
                self._push((self.periods * self.steps + number) * self.step_s)
            mujoco.mj_step(self.model, data)
        self.periods += 1
        self._tell()

    def _push(self, start):
        """The mean force over the step, on the link's centre of mass, as `plant::Push::force_over`."""
        data = self.data
        data.qfrc_applied[:] = 0
        for push in self.pushes:
            covered = min(start + self.step_s, push["start"] + push["duration"]) - max(start, push["start"])
            if covered > 0:
                force = np.array(push["impulse"]) * (covered / (push["duration"] * self.step_s))
                body = self.model.body(push["body"]).id
                mujoco.mj_applyFT(self.model, data, force, np.zeros(3), data.xipos[body], body, data.qfrc_applied)

    def _tell(self):
        data, state = self.data, self.state
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, data.qpos[3:7])
        state[0:7] = data.qpos[0:7]
        state[7:10] = rotation.reshape(3, 3) @ data.qvel[3:6]
        state[10:13] = data.qvel[0:3]
        state[13:33][self.powered] = data.qpos[self.qpos]
        state[33:53][self.powered] = data.qvel[self.dofs]
        for place, sensor in zip((53, 59), self.grounds):
            force, moment, point = data.sensordata[sensor : sensor + 9].reshape(3, 3)
            # The sensor's point and the right foot's place are both of the step's beginning.
            state[place : place + 3] = force
            state[place + 3 : place + 6] = moment + np.cross(point - data.xpos[1], force)
        state[65:85][self.powered] = data.qfrc_actuator[self.dofs] - self.back_emf * data.qvel[self.dofs]


def main():
    """Answers setpoints with states until there are no more."""
    told = json.loads(sys.stdin.buffer.readline())
    if told["protocol"] != PROTOCOL:
        sys.exit(f"halfstep speaks engine protocol {told['protocol']}, this MuJoCo plant {PROTOCOL}")
    robot = Robot(told)
    hello = {"protocol": PROTOCOL, "engine": f"MuJoCo {mujoco.__version__}", "setpoint": SETPOINT, "state": STATE}
    os.write(STATES, json.dumps(hello).encode() + b"\n")
    # Nobody left to answer is as good an end as no more setpoints.
    with contextlib.suppress(BrokenPipeError):
        while len(record := sys.stdin.buffer.read(8 * SETPOINT)) == 8 * SETPOINT:
            robot.setpoint[:] = np.frombuffer(record, "<f8").reshape(3, JOINTS)
            robot.advance()
            os.write(STATES, robot.state.astype("<f8", copy=False).tobytes())


if __name__ == "__main__":
    main()
