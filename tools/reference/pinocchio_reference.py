"""Writes tests/data/pinocchio_reference.json: what Pinocchio says of config/mechanism.toml.

Run from the repository's top folder (Python 3.11 or later); the file is committed, so tests never need this:

    python3 -m venv .venv-reference
    .venv-reference/bin/pip install pin==4.1.0
    .venv-reference/bin/python tools/reference/pinocchio_reference.py

Every number is checked here in a second way (`check_...`) before it is written.
"""

import json
import tomllib
from pathlib import Path

import numpy as np
import pinocchio as pin

GRAVITY = 9.80665
SEED = 20
FIXED_STATES = 20
MASS_MATRICES = 5
FLOATING_STATES = 10
PUSHED_STATES = 5
TOP = Path(__file__).resolve().parents[2]

CONVENTIONS = {
    "joints": "arrays per joint hold the 20 joints in the order of `joints`; radians, SI units",
    "rotor_inertia": "left out everywhere: links only",
    "fixed_base": "joint 1 sits at the world's origin O. torques: what the joints exert from parent on child, joints 1 "
    "and 2 included. ground force and moment: what the ground exerts on the robot, the moment about O, both in world "
    "axes. com in world coordinates. mass_matrix: 20 rows of 20; given for the first states only",
    "floating_base": "the base is the right foot link (frame on the sole, under the ankle); joints 1 and 2 do not "
    "exist, their entries are 0. base_orientation_xyzw and base_rotation (three rows) say the same: they map base to "
    "world coordinates. base_velocity: of the base frame's origin; base_acceleration: classical acceleration (second "
    "derivative of the world position) of that origin; both, and angular velocity and acceleration, in world axes. "
    "torques act in joints 3 to 20; accelerations are what follows",
    "floating_base_pushed": "as floating_base; a force and a moment act on the left foot link from outside, both in "
    "world axes, the moment about the left foot link's origin (the left ankle)",
}


def main():
    robot = tomllib.loads((TOP / "config/mechanism.toml").read_text())
    joints = sorted(robot["joint"], key=lambda name: robot["joint"][name]["number"])
    random = np.random.default_rng(SEED)
    fixed = fixed_model(robot, joints)
    floating = floating_model(robot, joints)
    reference = {
        "written_by": "tools/reference/pinocchio_reference.py",
        "seed": SEED,
        "pinocchio": pin.__version__,
        "mechanism": "config/mechanism.toml",
        "gravity": GRAVITY,
        "mass": pin.computeTotalMass(fixed),
        "joints": joints,
        "conventions": CONVENTIONS,
        "fixed_base": [fixed_state(fixed, robot, joints, random, n < MASS_MATRICES) for n in range(FIXED_STATES)],
        "floating_base": [floating_state(floating, robot, joints, random) for _ in range(FLOATING_STATES)],
        "floating_base_pushed": [floating_state(floating, robot, joints, random, True) for _ in range(PUSHED_STATES)],
    }
    path = TOP / "tests/data/pinocchio_reference.json"
    path.write_text(dumps(reference) + "\n")
    print(f"wrote {path.relative_to(TOP)}: {fixed.nq} joints, {reference['mass']:.3f} kg, Pinocchio {pin.__version__}")


def fixed_model(robot, joints):
    """The tree on the floor: 20 joints."""
    model = pin.Model()
    model.gravity.linear = np.array([0, 0, -GRAVITY])
    ids = {"ground": 0}
    for name in joints:
        add_joint(model, ids, name, robot["joint"][name])
    return model


def floating_model(robot, joints):
    """The tree in the air: a free-flyer that carries the right foot, and joints 3 to 20."""
    model = pin.Model()
    model.gravity.linear = np.array([0, 0, -GRAVITY])
    base, rest = joints[1], joints[2:]
    ids = {base: model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), base)}
    model.appendBodyToJoint(ids[base], inertia(robot["joint"][base]), pin.SE3.Identity())
    for name in rest:
        add_joint(model, ids, name, robot["joint"][name])
    return model


def add_joint(model, ids, name, table):
    origin = pin.SE3(np.eye(3), np.array(table["origin_m"], dtype=float))
    joint = pin.JointModelRevoluteUnaligned(np.array(table["axis"], dtype=float))
    ids[name] = model.addJoint(ids[table["parent"]], joint, origin, name)
    if "mass_kg" in table:
        model.appendBodyToJoint(ids[name], inertia(table), pin.SE3.Identity())


def inertia(table):
    return pin.Inertia(float(table["mass_kg"]), np.array(table["com_m"], dtype=float), np.diag(table["inertia_kg_m2"]))


def random_angles(robot, joints, random):
    """Within the joints' ranges; the foot tips by up to 0.2 rad."""
    tip = np.degrees(0.2)
    ranges = np.radians([robot["joint"][name].get("range_deg", [-tip, tip]) for name in joints])
    return random.uniform(ranges[:, 0], ranges[:, 1])


def fixed_state(model, robot, joints, random, with_mass_matrix):
    q = random_angles(robot, joints, random)
    v = random.uniform(-4, 4, model.nv)
    a = random.uniform(-30, 30, model.nv)
    data = model.createData()
    torques = pin.rnea(model, data, q, v, a).copy()
    # What joint 1 transmits, turned into world axes; its frame turns, but never leaves O. (rnea fills no oMi.)
    ground = data.liMi[1].act(data.f[1])
    com = pin.centerOfMass(model, data, q, v, a).copy()
    mass_matrix = symmetric(pin.crba(model, data, q))
    check_fixed(model, q, v, a, torques, ground, mass_matrix)
    state = {
        "angles": q,
        "rates": v,
        "accelerations": a,
        "torques": torques,
        "ground_force": ground.linear,
        "ground_moment": ground.angular,
        "com": com,
    }
    if with_mass_matrix:
        state["mass_matrix"] = mass_matrix
    return state


def check_fixed(model, q, v, a, torques, ground, mass_matrix):
    """Ground wrench by Newton and Euler for the whole robot; torques by mass matrix, and by forward dynamics."""
    data = model.createData()
    rate = pin.computeCentroidalMomentumTimeVariation(model, data, q, v, a).copy()
    weight = np.array([0, 0, GRAVITY * pin.computeTotalMass(model)])
    com = pin.centerOfMass(model, data, q).copy()
    close(ground.linear, rate.linear + weight)
    close(ground.angular, rate.angular + np.cross(com, rate.linear + weight))
    close(torques, mass_matrix @ a + pin.nonLinearEffects(model, data, q, v))
    close(a, pin.aba(model, model.createData(), q, v, torques), 1e-7)
    close(torques[0], ground.angular[0])  # joint 1 turns about x at O


def floating_state(model, robot, joints, random, pushed=False):
    position = random.uniform(-1, 1, 3) + np.array([0, 0, 1])
    axis = random.normal(size=3)
    rotation = pin.exp3(axis / np.linalg.norm(axis) * random.uniform(0, np.pi))
    quaternion = pin.Quaternion(rotation).coeffs()
    linear, angular = random.uniform(-1.5, 1.5, 3), random.uniform(-3, 3, 3)
    angles, rates = random_angles(robot, joints, random), random.uniform(-4, 4, len(joints))
    torques = random.uniform(-20, 20, len(joints))
    force, moment = random.uniform(-500, 500, 3), random.uniform(-40, 40, 3)
    for per_joint in (angles, rates, torques):
        per_joint[:2] = 0

    # Pinocchio's free-flyer wants velocities in the base's own axes.
    q = np.concatenate([position, quaternion, angles[2:]])
    v = np.concatenate([rotation.T @ linear, rotation.T @ angular, rates[2:]])
    tau = np.concatenate([np.zeros(6), torques[2:]])
    data = model.createData()
    pin.forwardKinematics(model, data, q)
    left_foot = model.getJointId("left_ankle_roll")
    outside = [pin.Force.Zero() for _ in range(model.njoints)]
    if pushed:
        to_link = data.oMi[left_foot].rotation.T
        outside[left_foot] = pin.Force(to_link @ force, to_link @ moment)
    acceleration = pin.aba(model, data, q, v, tau, outside).copy()

    # A spatial acceleration is the rate of change of body-axis velocities: the classical one has ω × v on top.
    base_acceleration = rotation @ (acceleration[:3] + np.cross(v[3:6], v[:3]))
    base_angular_acceleration = rotation @ acceleration[3:6]
    check_floating(model, q, v, tau, outside, acceleration, base_acceleration, base_angular_acceleration)
    state = {
        "base_position": position,
        "base_orientation_xyzw": quaternion,
        "base_rotation": rotation,
        "base_velocity": linear,
        "base_angular_velocity": angular,
        "angles": angles,
        "rates": rates,
        "torques": torques,
    }
    if pushed:
        state |= {"left_foot_force": force, "left_foot_moment": moment}
    return state | {
        "base_acceleration": base_acceleration,
        "base_angular_acceleration": base_angular_acceleration,
        "accelerations": np.concatenate([np.zeros(2), acceleration[6:]]),
    }


def check_floating(model, q, v, tau, outside, acceleration, base_acceleration, base_angular_acceleration):
    """Inverse dynamics gives the torques back; the base's accelerations are those seen by moving on a little."""
    close(pin.rnea(model, model.createData(), q, v, acceleration, outside), tau, 1e-8)

    def world_velocity(seconds):
        # Joint rates and base velocities change by acceleration · t, positions by integrating their mean.
        there = pin.integrate(model, q, seconds * (v + acceleration * seconds / 2))
        rotation = pin.Quaternion(there[3:7]).toRotationMatrix()
        velocity = v + acceleration * seconds
        return np.concatenate([rotation @ velocity[:3], rotation @ velocity[3:6]])

    step = 1e-5
    rate = (world_velocity(step) - world_velocity(-step)) / (2 * step)
    close(rate[:3], base_acceleration, 1e-5)
    close(rate[3:], base_angular_acceleration, 1e-5)


def close(value, expected, relative=1e-9):
    value, expected = np.asarray(value), np.asarray(expected)
    error = np.max(np.abs(value - expected)) / (1 + np.max(np.abs(expected)))
    assert error < relative, f"differs by {error:.1e}: {value} is not {expected}"


def symmetric(upper):
    """Pinocchio fills the upper triangle only."""
    return np.triu(upper) + np.triu(upper, 1).T


def dumps(value, indent=0):
    """JSON with one line per array of numbers, every bit kept."""
    pad = "  " * (indent + 1)
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, dict):
        lines = [f"{pad}{json.dumps(key)}: {dumps(item, indent + 1)}" for key, item in value.items()]
        return "{\n" + ",\n".join(lines) + "\n" + "  " * indent + "}"
    if isinstance(value, list) and isinstance(value[0], (dict, list)):
        lines = [pad + dumps(item, indent + 1) for item in value]
        return "[\n" + ",\n".join(lines) + "\n" + "  " * indent + "]"
    return json.dumps(value, ensure_ascii=False)


if __name__ == "__main__":
    main()
