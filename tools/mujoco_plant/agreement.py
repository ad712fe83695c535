"""What MuJoCo says of the exported robot: `tests/python/mujoco_agrees.rs` compares it with our own dynamics.

Reads `{"mjcf": …, "joints": [20 names], "states": [{"angles", "rates", "accelerations"}, …]}` from stdin, with the right
foot's sole turned by joints 1 (about x) and 2 (about y) on the spot, and prints mass, and per state the torques, the
ground's force and moment about O, the centre of mass and the mass matrix by those 20 coordinates, without rotors.
"""

import json
import sys

import mujoco
import numpy as np


def main():
    """Reads, computes, prints."""
    told = json.load(sys.stdin)
    model = mujoco.MjModel.from_xml_string(told["mjcf"])
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    # Joint limits are constraints too.
    model.jnt_limited[:] = 0
    model.dof_armature[:] = 0
    states = [state(model, told["joints"][2:], each) for each in told["states"]]
    print(json.dumps({"mass": mujoco.mj_getTotalmass(model), "states": states}))


def state(model, powered, motion):
    """One motion, standing on the right foot."""
    q, v, a = (np.array(motion[key]) for key in ("angles", "rates", "accelerations"))
    qpos = [model.joint(name).qposadr[0] for name in powered]
    dofs = [model.joint(name).dofadr[0] for name in powered]

    # The foot: a roll about x, then a pitch about the axis that has rolled along.
    sole = np.zeros(4)
    roll, pitch = (np.array([np.cos(angle / 2), 0, 0, 0]) for angle in q[:2])
    roll[1], pitch[2] = np.sin(q[:2] / 2)
    mujoco.mju_mulQuat(sole, roll, pitch)
    to_world, axes = np.zeros(9), np.zeros(9)
    mujoco.mju_quat2Mat(to_world, sole)
    mujoco.mju_quat2Mat(axes, roll)
    to_world, x, y = to_world.reshape(3, 3), np.array([1.0, 0, 0]), axes.reshape(3, 3)[:, 1]
    rate = x * v[0] + y * v[1]
    acceleration = x * a[0] + y * a[1] + np.cross(x * v[0], y * v[1])

    data = mujoco.MjData(model)
    data.qpos[3:7] = sole
    data.qvel[3:6], data.qacc[3:6] = to_world.T @ rate, to_world.T @ acceleration
    data.qpos[qpos], data.qvel[dofs], data.qacc[dofs] = q[2:], v[2:], a[2:]
    mujoco.mj_inverse(model, data)
    force, moment = data.qfrc_inverse[:3], to_world @ data.qfrc_inverse[3:6]

    # Rates of the 20 coordinates to MuJoCo's velocities.
    to_velocities = np.zeros((model.nv, 2 + len(powered)))
    to_velocities[3:6, 0], to_velocities[3:6, 1] = to_world.T @ x, to_world.T @ y
    to_velocities[dofs, range(2, 2 + len(powered))] = 1
    mass_matrix = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass_matrix)
    return {
        "torques": [x @ moment, y @ moment, *data.qfrc_inverse[dofs]],
        "ground_force": list(force),
        "ground_moment": list(moment),
        "com": list(data.subtree_com[0]),
        "mass_matrix": (to_velocities.T @ mass_matrix @ to_velocities).tolist(),
    }


if __name__ == "__main__":
    main()
