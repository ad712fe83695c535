"""The models stand, keep their torque limits, and are pushed as they should be."""

import math
import time

import mujoco
import numpy as np

import plant

from .told import GRAVITY, PERIOD_S, centre_of_mass, index, start

# Posture in which the robots stand.
KNEE = 0.3


def bent(told, lean):
    """Angles with bent knees, and the whole robot leaning ahead about its ankles."""
    angles = np.zeros(plant.JOINTS)
    # Up the right leg and down the left one, the same motion has opposite signs.
    for side, sign in (("right", 1), ("left", -1)):
        angles[index(f"{side}_knee")] = -sign * KNEE
        angles[index(f"{side}_ankle_pitch")] = sign * (KNEE / 2 + lean)
        angles[index(f"{side}_hip_pitch")] = sign * KNEE / 2
    return angles


def standing(told):
    """A posture with the centre of mass above the ankles."""

    def ahead(lean):
        return centre_of_mass(plant.UrdfRobot(told | {"start": start(bent(told, lean))}))[0]

    low, high = -0.4, 0.4
    assert ahead(low) < 0 < ahead(high), "no lean brings the centre of mass above the ankles"
    for _ in range(20):
        middle = (low + high) / 2
        low, high = (middle, high) if ahead(middle) < 0 else (low, middle)
    return bent(told, low)


def check_standing(name, told, reader):
    """It stays up, with its weight on the soles. Returns sag of held joints and tilt (degrees), and speed."""
    angles = standing(told)
    robot = plant.UrdfRobot(told | {"start": start(angles)})
    robot.setpoint[0] = angles
    height = centre_of_mass(robot)[2]
    sag, periods = 0.0, round(2 / PERIOD_S)
    began = time.perf_counter()
    for period in range(periods):
        robot.advance(period)
        for qpos, at in robot.held:
            sag = max(sag, abs(robot.data.qpos[qpos] - at))
    taken = (time.perf_counter() - began) / (periods * PERIOD_S)
    mujoco.mj_comPos(robot.model, robot.data)
    state, com = robot.state, centre_of_mass(robot)
    force = state[53:56] + state[59:62]
    weight = reader.mass * GRAVITY
    assert abs(com[2] / height - 1) < 0.02, f"{name}: the centre of mass fell from {height} to {com[2]} m"
    assert abs(force[2] / weight - 1) < 0.01, f"{name}: {force} N on the soles, the weight is {weight} N"
    assert min(state[55], state[61]) > 0.3 * weight, f"{name}: stands on one leg"
    # The ground's moment about the right sole's origin is the weight's.
    moment = state[56:59] + state[62:65]
    weights = np.cross(com - state[0:3], [0, 0, weight])
    arm = np.abs(moment - weights)[:2].max() / weight
    assert arm < 0.005, f"{name}: moment {moment} N m, the weight's is {weights} N m"
    assert math.degrees(sag) < 2, f"{name}: a held joint sags by {math.degrees(sag)}°"
    tilt = 2 * math.degrees(math.asin(min(1, np.linalg.norm(state[4:7]))))
    return math.degrees(sag), tilt, taken, np.abs(state[65:85]).max(), robot


def check_limits(name, told):
    """However far the targets are, no torque exceeds the effort. The robot's weight limits efforts without meaning."""
    setup = told["urdf_setup"]
    most = told["stiffness"][0]
    joints = [joint | {"effort": min(joint["effort"], most)} for joint in setup["joints"]]
    robot = plant.UrdfRobot(told | {"urdf_setup": setup | {"joints": joints}})
    efforts = np.array([joint["effort"] for joint in joints])
    present = [index(role) for role in told["joints"]]
    random = np.random.default_rng(5)
    reached = np.zeros(len(efforts))
    for period in range(400):
        if period % 40 == 0:
            robot.setpoint[0] = random.uniform(-1, 1, plant.JOINTS)
            robot.setpoint[2][present] = random.uniform(-2, 2, len(efforts)) * efforts
        robot.advance(period)
        assert np.isfinite(robot.state).all(), f"{name}: not finite"
        reached = np.maximum(reached, np.abs(robot.state[65:85][present]))
    assert (reached <= efforts * (1 + 1e-12)).all(), f"{name}: {reached} N m with limits {efforts}"
    assert (reached > 0.999 * efforts).any(), f"{name}: no torque came to its limit"


def check_push(name, told, reader):
    """A push, in free fall, gives the robot its momentum and turns it about its centre of mass as it should."""
    impulse = 0.1 * reader.mass
    push = {"body": "trunk", "impulse": [0, impulse, 0], "start": 0.0, "duration": 0.01}
    setup = told["urdf_setup"] | {"gravity": [0, 0, 0]}
    raised = told["start"] | {"position": [0, 0, 1]}
    robot = plant.UrdfRobot(told | {"pushes": [push], "urdf_setup": setup, "start": raised})
    for period in range(20):
        robot.advance(period)
    mujoco.mj_subtreeVel(robot.model, robot.data)
    momentum = reader.mass * robot.data.subtree_linvel[0]
    assert np.abs(momentum - push["impulse"]).max() < 1e-3 * impulse, f"{name}: momentum {momentum}"
    # A push that begins with a period has no part in the one before, as in the plant, whose bits a script repeats.
    for period in range(100):
        robot.pushes = [push | {"start": (period + 1) * PERIOD_S}]
        robot.advance(period)
        assert not robot.data.qfrc_applied.any(), f"{name}: pushed before {robot.pushes[0]['start']} s"
