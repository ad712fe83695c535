"""Masses, places and velocities of the models are those of the URDFs."""

import math

import mujoco
import numpy as np

import plant
from plant import SIDES

from .told import at_once, centre_of_mass, index, start


def check_mass(name, robot, reader):
    """The model weighs what the URDF says."""
    mass = mujoco.mj_getTotalmass(robot.model)
    assert abs(mass / reader.mass - 1) < 1e-6, f"{name}: {mass} kg, the URDF has {reader.mass} kg"


def check_soles(name, robot, told):
    """At zero posture both soles are level and where the URDF has them."""
    soles = {side: robot.data.site(f"{side}_sole") for side in SIDES}
    apart = np.subtract(told["urdf_setup"]["soles"]["left"], told["urdf_setup"]["soles"]["right"])
    for side, site in soles.items():
        assert np.abs(site.xmat.reshape(3, 3) - np.eye(3)).max() < 1e-12, f"{name}: the {side} sole is not level"
    assert np.abs(soles["right"].xpos).max() < 1e-12, f"{name}: the right sole is at {soles['right'].xpos}"
    assert np.abs(soles["left"].xpos - apart).max() < 1e-12, f"{name}: the left sole is at {soles['left'].xpos}"
    # The boxes' lower faces are the soles.
    for side in SIDES:
        geom = robot.model.geom(f"{side}_foot_on_floor").id
        bottom = robot.data.geom_xpos[geom] - [0, 0, robot.model.geom_size[geom, 2]]
        sole = told["urdf_setup"]["sole"]
        outward = (sole["outside"] - sole["inside"]) / 2
        aside = outward if side == "left" else -outward
        expected = soles[side].xpos + [(sole["ahead"] - sole["behind"]) / 2, aside, 0]
        assert np.abs(bottom - expected).max() < 1e-12, f"{name}: the {side} box is at {bottom}"


def check_kinematics(name, told, reader):
    """In some posture left foot and centre of mass are where the URDF has them, seen from the right sole."""
    angles, setup = np.zeros(plant.JOINTS), told["urdf_setup"]
    random = np.random.default_rng(7)
    urdf_angles = {joint["urdf"]: joint["at"] for joint in setup["held"]}
    zero = dict(urdf_angles)
    for joint in setup["joints"]:
        urdf_angles[joint["urdf"]] = random.uniform(-0.3, 0.3)
        angles[index(joint["role"])] = joint["sign"] * urdf_angles[joint["urdf"]]
    robot = plant.UrdfRobot(told | {"start": start(angles)})
    frames = {}
    for side in SIDES:
        foot = reader.joints[setup["feet"][side]["joint"]].find("child").get("link")
        (turn, at), (turn_0, at_0) = reader.place(foot, urdf_angles), reader.place(foot, zero)
        frames[side] = turn @ turn_0.T, at + turn @ turn_0.T @ (np.array(setup["soles"][side]) - at_0)
    back = frames["right"][0].T
    place, turn = back @ (frames["left"][1] - frames["right"][1]), back @ frames["left"][0]
    left = robot.data.site("left_sole")
    assert np.abs(left.xpos - place).max() < 1e-9, f"{name}: the left sole is at {left.xpos}, not at {place}"
    assert np.abs(left.xmat.reshape(3, 3) - turn).max() < 1e-9, f"{name}: the left sole is turned"
    com = back @ (reader.centre_of_mass(urdf_angles) - frames["right"][1])
    error = np.abs(centre_of_mass(robot) - com).max()
    assert error < 1e-6, f"{name}: the centre of mass is at {centre_of_mass(robot)}, not at {com}"


def check_round_trip(name, told):
    """What the state says at first is what the start says, and the velocities are the rates of change."""
    random = np.random.default_rng(3)
    began = start(random.uniform(-0.2, 0.2, plant.JOINTS))
    began["rates"] = list(random.uniform(-1, 1, plant.JOINTS))
    began["position"], began["velocity"] = [0.3, -2.0, 0.5], [0.4, 0.2, -0.1]
    orientation = random.normal(size=4)
    began["orientation"] = list(orientation / np.linalg.norm(orientation))
    began["angular_rate"] = [0.5, -1.0, 2.0]
    robot = plant.UrdfRobot(told | {"start": began})
    state = at_once(robot)
    orientation = state[3:7] * math.copysign(1, state[3:7] @ began["orientation"])
    present = [index(role) for role in told["joints"]]
    absent = [place for place in range(plant.JOINTS) if place not in present]
    for got, expected in (
        (state[0:3], began["position"]),
        (orientation, began["orientation"]),
        (state[7:10], began["angular_rate"]),
        (state[10:13], began["velocity"]),
        (state[13:33][present], np.array(began["angles"])[present]),
        (state[33:53][present], np.array(began["rates"])[present]),
        (state[13:33][absent], 0),
        (state[33:53][absent], 0),
    ):
        assert np.abs(got - np.array(expected)).max(initial=0) < 1e-9, f"{name}: started with {expected}, is {got}"
    moment = 1e-6
    qpos = robot.data.qpos.copy()
    places = []
    for sign in (-1, 1):
        robot.data.qpos[:] = qpos
        mujoco.mj_integratePos(robot.model, robot.data.qpos, robot.data.qvel, sign * moment)
        places.append(at_once(robot)[0:3])
    velocity = (places[1] - places[0]) / (2 * moment)
    assert np.abs(velocity - began["velocity"]).max() < 1e-6, f"{name}: moves with {velocity}"


def check_payload(name, told, reader):
    """A payload adds its mass at its place."""
    at = np.array([0.1, 0.05, 0.3])
    bare = plant.UrdfRobot(told)
    setup = told["urdf_setup"] | {"payload": {"mass": 2.0, "at": list(at)}}
    robot = plant.UrdfRobot(told | {"urdf_setup": setup})
    seen = at - setup["soles"]["right"]
    expected = (reader.mass * centre_of_mass(bare) + 2.0 * seen) / (reader.mass + 2.0)
    assert np.abs(centre_of_mass(robot) - expected).max() < 1e-6, f"{name}: the payload is elsewhere"
    assert abs(mujoco.mj_getTotalmass(robot.model) - reader.mass - 2.0) < 1e-5


def check_mass_error(name, told, reader):
    """Masses are wrong by no more than they should be, the same for the same seed."""
    share = 0.1
    masses = []
    for seed in (1, 1, 2):
        setup = told["urdf_setup"] | {"mass_error": {"share": share, "seed": seed}}
        masses.append(mujoco.mj_getTotalmass(plant.UrdfRobot(told | {"urdf_setup": setup}).model))
    assert masses[0] == masses[1] != masses[2], f"{name}: masses {masses} kg"
    assert all(0 < abs(mass / reader.mass - 1) < share for mass in masses), f"{name}: masses {masses} kg"
