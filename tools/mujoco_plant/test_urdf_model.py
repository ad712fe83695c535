"""Checks the models that `plant.py` makes of URDFs: `python test_urdf_model.py ROBOTS [NAME …]`.

ROBOTS is a folder of folders, each with a `robot.urdf` and a `sole.toml`; with names, only those are checked. Each of
them stands, meets its torque limits, and is compared with what the URDF itself says. The first of them is then given
peculiarities that other URDFs have. Prints a table with a line per robot, and stops at the first thing that is wrong.
"""

import json
import math
import subprocess
import sys
import time
import tomllib
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np

import plant

SIDES = plant.SIDES
GRAVITY = 9.80665
PERIOD_S, STEPS = 1e-3, 2
# The mechanism's axes. Its tree goes up the right leg, so that its joints there turn the other way than a URDF's.
ROLL, PITCH, YAW = np.eye(3)
AXES = {
    **{"ankle_roll": ROLL, "ankle_pitch": PITCH, "knee": PITCH, "hip_pitch": PITCH, "hip_yaw": YAW, "hip_roll": ROLL},
    **{"waist_pitch": PITCH, "waist_roll": ROLL, "shoulder": PITCH, "elbow": PITCH},
}
LEG = ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")
# Posture in which the robots stand.
KNEE = 0.3


def legs(**patterns):
    """A table from the mechanism's joints to a URDF's, with a side's letters in braces."""
    table = {}
    for side in SIDES:
        words = {"side": side, "Side": side.capitalize(), "s": side[0], "S": side[0].upper()}
        table |= {f"{side}_{joint}": pattern.format(**words) for joint, pattern in patterns.items()}
    return table


UNITREE = legs(**{joint: f"{{side}}_{joint}_joint" for joint in LEG}, shoulder="{side}_shoulder_pitch_joint")
UNITREE |= legs(elbow="{side}_elbow_joint")
WAIST = {"waist_roll": "waist_roll_joint", "waist_pitch": "waist_pitch_joint"}
# Joints, trunk, and whether the legs hang on the waist, so that it turns the other way.
ROBOTS = {
    "g1": (UNITREE | WAIST, "torso_link", False),
    "h1_2": (UNITREE, "torso_link", False),
    "limx": (UNITREE | WAIST, "waist_pitch_link", False),
    "gr1t1": (
        UNITREE | WAIST | legs(knee="{side}_knee_pitch_joint", elbow="{side}_elbow_pitch_joint"),
        *("torso_link", False),
    ),
    "jvrc1": (
        legs(hip_pitch="{S}_HIP_P", hip_roll="{S}_HIP_R", hip_yaw="{S}_HIP_Y", knee="{S}_KNEE")
        | legs(ankle_pitch="{S}_ANKLE_P", ankle_roll="{S}_ANKLE_R", shoulder="{S}_SHOULDER_P", elbow="{S}_ELBOW_P")
        | {"waist_pitch": "WAIST_P", "waist_roll": "WAIST_R"},
        *("WAIST_R_S", False),
    ),
    "op3": (
        legs(**{joint: f"{{s}}_{joint.replace('ankle', 'ank')}" for joint in LEG}, shoulder="{s}_sho_pitch"),
        *("body_link", False),
    ),
    "qinglong": (
        legs(hip_roll="J_hip_{s}_roll", hip_yaw="J_hip_{s}_yaw", hip_pitch="J_hip_{s}_pitch", shoulder="J_arm_{s}_01")
        | legs(knee="J_knee_{s}_pitch", ankle_pitch="J_ankel_{s}_pitch", ankle_roll="J_ankel_{s}_roll")
        | {"left_hip_roll": "J_hipl_l_roll", "waist_pitch": "J_waist_pitch", "waist_roll": "J_waist_roll"},
        *("link_base", True),
    ),
    "t1": (
        legs(**{joint: f"{{Side}}_{joint.title()}" for joint in LEG if joint != "knee"}, knee="{Side}_Knee_Pitch")
        | legs(shoulder="{Side}_Shoulder_Pitch"),
        *("Trunk", True),
    ),
    "talos": (
        legs(hip_yaw="leg_{side}_1_joint", hip_roll="leg_{side}_2_joint", hip_pitch="leg_{side}_3_joint")
        | legs(knee="leg_{side}_4_joint", ankle_pitch="leg_{side}_5_joint", ankle_roll="leg_{side}_6_joint")
        | legs(elbow="arm_{side}_4_joint")
        | {"waist_pitch": "torso_2_joint"},
        *("torso_2_link", False),
    ),
}
# Ranges that contradict the other leg's.
RANGES = {"qinglong": {"J_knee_l_pitch": [-0.08727, 2.3562], "J_hip_r_pitch": [-1.8326, 0.7854]}}


class Reader:
    """A URDF, read without MuJoCo."""

    def __init__(self, text):
        root = ElementTree.fromstring(text)
        self.joints = {joint.get("name"): joint for joint in root.findall("joint")}
        self.above = {joint.find("child").get("link"): joint for joint in root.findall("joint")}
        self.inertials = [(link.get("name"), link.find("inertial")) for link in root.findall("link[inertial]")]
        self.mass = sum(float(inertial.find("mass").get("value")) for _, inertial in self.inertials)

    def moving(self):
        """The joints that move."""
        return [name for name, joint in self.joints.items() if joint.get("type") != "fixed"]

    def limit(self, name, key):
        """A joint's limit, or None."""
        limit = self.joints[name].find("limit")
        return None if limit is None or limit.get(key) is None else float(limit.get(key))

    def place(self, link, angles):
        """Rotation and origin of a link, in the root's coordinates."""
        if link not in self.above:
            return np.eye(3), np.zeros(3)
        joint = self.above[link]
        turn, at = self.place(joint.find("parent").get("link"), angles)
        origin = joint.find("origin")
        told = {} if origin is None else origin.attrib
        xyz, rpy = (np.array(told.get(key, "0 0 0").split(), dtype=float) for key in ("xyz", "rpy"))
        at = at + turn @ xyz
        turn = turn @ about(YAW, rpy[2]) @ about(PITCH, rpy[1]) @ about(ROLL, rpy[0])
        if (angle := angles.get(joint.get("name"), 0)) != 0:
            turn = turn @ about(np.array(joint.find("axis").get("xyz").split(), dtype=float), angle)
        return turn, at

    def centre_of_mass(self, angles):
        """Of the whole robot, in the root's coordinates."""
        moment = np.zeros(3)
        for link, inertial in self.inertials:
            turn, at = self.place(link, angles)
            origin = inertial.find("origin")
            xyz = "0 0 0" if origin is None else origin.get("xyz", "0 0 0")
            moment += float(inertial.find("mass").get("value")) * (at + turn @ np.array(xyz.split(), dtype=float))
        return moment / self.mass

    def axis(self, name, angles):
        """Direction and place of a joint's axis, in the root's coordinates."""
        joint = self.joints[name]
        turn, at = self.place(joint.find("child").get("link"), angles)
        return turn @ np.array(joint.find("axis").get("xyz").split(), dtype=float), at


def about(axis, angle):
    """The rotation about an axis."""
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def first_message(folder, name):
    """What `plant.py` is told of a robot that stands upright, and the robot's URDF as read here."""
    text = (folder / name / "robot.urdf").read_text(encoding="utf-8")
    sole = tomllib.loads((folder / name / "sole.toml").read_text(encoding="utf-8"))["sole"]
    table, trunk, hanging = ROBOTS[name]
    reader = Reader(text)
    held = {joint: resting(reader, joint) for joint in reader.moving() if joint not in table.values()}
    ranges, soles = RANGES.get(name, {}), {}
    for side in SIDES:
        pitch, roll = (reader.axis(table[f"{side}_ankle_{kind}"], held)[1] for kind in ("pitch", "roll"))
        soles[side] = [pitch[0], roll[1], pitch[2] - sole["ankle_height_m"]]
    leg = reader.axis(table["right_hip_pitch"], held)[1][2] - soles["right"][2]
    strength, inertia = reader.mass * GRAVITY * leg, reader.mass * leg**2
    roles = [role for role in plant.POWERED if role in table]
    signs = []
    for role in roles:
        kind = role.removeprefix("right_").removeprefix("left_")
        upward = role.startswith("right_") and kind in LEG or role.startswith("waist_") and hanging
        along = reader.axis(table[role], held)[0] @ AXES[kind]
        assert abs(along) > 0.8, f"{name}: {role} is not about the mechanism's axis"
        signs.append(math.copysign(1, along) * (-1 if upward else 1))
    last = {side: "ankle_pitch" if name == "jvrc1" else "ankle_roll" for side in SIDES}
    setup = {
        "joints": [
            {"role": role, "urdf": table[role], "sign": sign, "effort": reader.limit(table[role], "effort")}
            | {"armature": (2e-3 if role.split("_")[1] in ("hip", "knee", "ankle") else 5e-4) * inertia}
            | ({"range": ranges[table[role]]} if table[role] in ranges else {})
            for role, sign in zip(roles, signs)
        ],
        "held": [{"urdf": joint, "at": at, "armature": 2e-4 * inertia} for joint, at in held.items()],
        "servo": {
            "legs_and_waist": {"stiffness": 8 * strength, "damping": 0.24 * strength},
            "arms": {"stiffness": 1.5 * strength, "damping": 0.03 * strength},
        },
        "feet": {side: {"joint": table[f"{side}_{last[side]}"]} for side in SIDES},
        "soles": soles,
        "sole": {"behind": sole["behind_m"], "ahead": sole["ahead_m"], "half_width": sole["width_m"] / 2},
        "trunk_link": trunk,
        "to_ahead": [1, 0, 0, 0],
        "friction": 0.8,
        "gravity": [0, 0, -GRAVITY],
        "payload": {"mass": 0, "at": [0, 0, 0]},
        "mass_error": {"share": 0, "seed": 0},
    }
    stiffness = [8 * strength] * len(roles)
    told = {
        "protocol": plant.PROTOCOL,
        "urdf": text,
        "urdf_setup": setup,
        "period_s": PERIOD_S,
        "steps_per_period": STEPS,
        "joints": roles,
        "stiffness": stiffness,
        "damping": [0.03 * each for each in stiffness],
        "back_emf": [0.0] * len(roles),
        "start": start(np.zeros(plant.JOINTS)),
        "pushes": [],
    }
    return told, reader


def resting(reader, joint):
    """The angle nearest to 0 that a joint can have."""
    lower, upper = reader.limit(joint, "lower"), reader.limit(joint, "upper")
    return 0.0 if lower is None or upper is None else min(max(0.0, lower), upper)


def start(angles):
    """The right sole at rest at the origin."""
    return {
        "position": [0, 0, 0],
        "orientation": [1, 0, 0, 0],
        "angular_rate": [0, 0, 0],
        "velocity": [0, 0, 0],
        "angles": list(angles),
        "rates": [0.0] * plant.JOINTS,
    }


def at_once(robot):
    """The state before anything has moved."""
    robot._tell()
    return robot.state.copy()


def index(role):
    """A joint's place among the twenty."""
    return 2 + plant.POWERED.index(role)


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
        expected = soles[side].xpos + [(sole["ahead"] - sole["behind"]) / 2, 0, 0]
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


def bent(told, lean):
    """Angles with bent knees, and the whole robot leaning ahead about its ankles."""
    angles = np.zeros(plant.JOINTS)
    # Up the right leg and down the left one, the same motion has opposite signs.
    for side, sign in (("right", 1), ("left", -1)):
        angles[index(f"{side}_knee")] = -sign * KNEE
        angles[index(f"{side}_ankle_pitch")] = sign * (KNEE / 2 + lean)
        angles[index(f"{side}_hip_pitch")] = sign * KNEE / 2
    return angles


def centre_of_mass(robot):
    """In the world."""
    return robot.data.subtree_com[0]


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
    for _ in range(periods):
        robot.advance()
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
        robot.advance()
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
    for _ in range(20):
        robot.advance()
    mujoco.mj_subtreeVel(robot.model, robot.data)
    momentum = reader.mass * robot.data.subtree_linvel[0]
    assert np.abs(momentum - push["impulse"]).max() < 1e-3 * impulse, f"{name}: momentum {momentum}"


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


def check_pipes(name, told):
    """The process answers as the class does."""
    robot = plant.UrdfRobot(told)
    command = [sys.executable, "-I", plant.__file__]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        process.stdin.write(json.dumps(told).encode() + b"\n")
        process.stdin.flush()
        hello = json.loads(process.stdout.readline())
        assert (hello["setpoint"], hello["state"]) == (plant.SETPOINT, plant.STATE), hello
        for period in range(5):
            robot.setpoint[0] = 0.001 * period
            robot.advance()
            process.stdin.write(robot.setpoint.astype("<f8").tobytes())
            process.stdin.flush()
            state = np.frombuffer(process.stdout.read(8 * plant.STATE), "<f8")
            assert (state == robot.state).all(), f"{name}: another state through the pipe"
        process.stdin.close()
    assert process.returncode == 0, process.returncode


def check_root(told, shift, periods):
    """A root that lies obliquely and elsewhere, called `world` and with a floating joint, changes nothing at first.

    Where it is decides over the error of integration, so that a shifted one does change a little later on.
    """
    turn = np.array([0.8, 0.2, -0.4, 0.4])
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, turn)
    rotation = rotation.reshape(3, 3)
    roll, yaw = (math.atan2(rotation[at], rotation[by]) for at, by in (((2, 1), (2, 2)), ((1, 0), (0, 0))))
    rpy = (roll, -math.asin(rotation[2, 0]), yaw)
    robot = ElementTree.fromstring(told["urdf"])
    root = robot.find("link").get("name")
    ElementTree.SubElement(robot, "link", name="world")
    joint = ElementTree.SubElement(robot, "joint", name="floating_base", type="floating")
    ElementTree.SubElement(joint, "parent", link="world")
    ElementTree.SubElement(joint, "child", link=root)
    ElementTree.SubElement(joint, "origin", xyz=" ".join(map(repr, map(float, shift))), rpy=" ".join(map(repr, rpy)))
    setup = told["urdf_setup"]
    turned = setup | {
        "soles": {side: list(shift + rotation @ sole) for side, sole in setup["soles"].items()},
        "to_ahead": list(turn * [1, -1, -1, -1]),
        "payload": {"mass": 1.0, "at": list(shift + rotation @ [0.1, 0.05, 0.3])},
    }
    plain = setup | {"payload": {"mass": 1.0, "at": [0.1, 0.05, 0.3]}}
    urdf = ElementTree.tostring(robot, encoding="unicode")
    moving = start(np.full(plant.JOINTS, 0.05)) | {"angular_rate": [0.1, 0.2, 0.3], "position": [0, 0, 0.01]}
    told = told | {"start": moving, "pushes": [{"body": "pelvis", "impulse": [1, 2, 3], "start": 0, "duration": 0.1}]}
    changes = {"urdf_setup": plain}, {"urdf": urdf, "urdf_setup": turned}
    robots = [plant.UrdfRobot(told | change) for change in changes]
    states = [at_once(robot) for robot in robots]
    lefts = [robot.data.site("left_sole").xpos for robot in robots]
    coms = [centre_of_mass(robot) for robot in robots]
    for pair in (states, lefts, coms):
        assert np.abs(pair[0] - pair[1]).max() < 1e-9, f"an oblique root at {shift}: {pair}"
    for _ in range(periods):
        for robot in robots:
            robot.advance()
        error = np.abs(robots[0].state[:53] - robots[1].state[:53]).max()
        assert error < 1e-6, f"an oblique root makes a difference of {error}"
    assert periods == 0 or robots[0].state[[55, 61]].any(), "no foot has come to the floor"


PECULIAR = """
<link name="kopfstütze"/> <link name="kugel"><inertial><mass value="0.2"/></inertial></link>
<link name="schiene"><inertial><origin xyz="0 0 0.1"/><mass value="0.3"/>
  <inertia ixx="0.001" iyy="0.001" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="tip"/> <link name="tip2"/>
<joint name="dreh_ö" type="continuous"><parent link="{trunk}"/><child link="kopfstütze"/><axis xyz="0 0 1"/></joint>
<joint name="slide" type="prismatic"><parent link="kopfstütze"/><child link="schiene"/><origin xyz="0 0 0.2"/></joint>
<joint name="follower" type="revolute"><parent link="schiene"/><child link="kugel"/><axis xyz="0 2 0"/>
  <mimic joint="slide" multiplier="2"/><limit effort="5" velocity="1"/></joint>
<joint name="same" type="fixed"><parent link="kugel"/><child link="tip"/></joint>
<joint name="same" type="fixed"><parent link="kugel"/><child link="tip2"/></joint>
</robot>
"""


def check_peculiar(told):
    """Massless, impossible and point-like links, joints without limits, of other kinds, and with unusual names."""
    setup = told["urdf_setup"]
    urdf = told["urdf"].rstrip().removesuffix("</robot>") + PECULIAR.format(trunk=setup["trunk_link"])
    servo = {"at": 0.1, "armature": 0.001}
    held = [servo | {"urdf": joint} for joint in ("dreh_ö", "slide", "follower")]
    told = told | {"urdf": urdf, "urdf_setup": setup | {"held": setup["held"] + held}}
    robot = plant.UrdfRobot(told)
    mass = Reader(urdf).mass
    assert abs(mujoco.mj_getTotalmass(robot.model) / mass - 1) < 1e-6, "a massless link weighs"
    for _ in range(300):
        robot.advance()
    for place, at in robot.held:
        assert abs(robot.data.qpos[place] - at) < 0.035, f"a held joint is at {robot.data.qpos[place]}, not at {at}"
    for each in (setup["held"], [*setup["held"], *held, held[0]], [*setup["held"], *held, servo | {"urdf": "same"}]):
        refused(told | {"urdf_setup": setup | {"held": each}})
    for this, that in (
        ('<link name="tip2"/>', '<link name="tip2"/><link name="tip2"/>'),
        ('<link name="tip2"/>', '<link name="tip2"/><link name="lost"/>'),
        ('name="slide" type="prismatic"', 'name="slide" type="planar"'),
        ('name="slide" type="prismatic"', 'name="slide" type="floating"'),
        ('<child link="tip2"/>', '<child link="nowhere"/>'),
        ('<child link="tip2"/>', '<child link="tip"/>'),
        ("</robot>", ""),
    ):
        refused(told | {"urdf": urdf.replace(this, that)})
    refused(told | {"joints": told["joints"][1:]})
    refused(told | {"pushes": [{"body": "tail", "impulse": [1, 0, 0], "start": 0, "duration": 1}]})
    refused(told | {"urdf_setup": told["urdf_setup"] | {"trunk_link": "tail"}})


def refused(told):
    """The robot cannot be built, and the reason is told."""
    try:
        plant.UrdfRobot(told)
    except (ValueError, ElementTree.ParseError) as error:
        assert str(error)
    else:
        raise AssertionError("a wrong URDF or setup is not noticed")


def check_robot(folder, name):
    """All checks of one robot. Returns a line of the table."""
    told, reader = first_message(folder, name)
    began = time.perf_counter()
    robot = plant.UrdfRobot(told)
    load = time.perf_counter() - began
    check_mass(name, robot, reader)
    check_soles(name, robot, told)
    check_kinematics(name, told, reader)
    check_round_trip(name, told)
    check_payload(name, told, reader)
    check_mass_error(name, told, reader)
    check_push(name, told, reader)
    check_limits(name, told)
    sag, tilt, taken, torque, robot = check_standing(name, told, reader)
    contact = robot.model.geom("floor").solref[0]
    return (
        f"{name:9} {reader.mass:6.2f} {robot.model.nv - 6:6} {robot.model.nbody:6} {1e3 * contact:8.2f} {sag:6.3f} "
        f"{tilt:6.3f} {torque:8.2f} {load:6.2f} {taken:8.3f}"
    )


def main():
    """Checks the robots that the command line names, or all."""
    folder = Path(sys.argv[1])
    print("robot         kg joints bodies  contact    sag   tilt   torque   load     wall")
    print("                                     ms    deg    deg      N m      s      s/s")
    names = sys.argv[2:] or list(ROBOTS)
    for name in names:
        print(check_robot(folder, name), flush=True)
    told, _ = first_message(folder, names[0])
    check_pipes(names[0], told)
    check_root(told, np.array([0.3, -0.2, 0.1]), 0)
    check_root(told, np.zeros(3), 200)
    check_peculiar(told)


if __name__ == "__main__":
    main()
