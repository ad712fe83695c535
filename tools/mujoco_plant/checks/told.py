"""What the plant is told of a robot, and what it tells."""

import math
import tomllib

import numpy as np

import plant
from plant import SIDES

from .reader import PITCH, ROLL, YAW, Reader
from .robots import LEG, RANGES, ROBOTS

GRAVITY = 9.80665
PERIOD_S, STEPS = 1e-3, 2
EDGES = ("behind", "ahead", "inside", "outside")
# The mechanism's axes. Its tree goes up the right leg, so that its joints there turn the other way than a URDF's.
AXES = {
    **{"ankle_roll": ROLL, "ankle_pitch": PITCH, "knee": PITCH, "hip_pitch": PITCH, "hip_yaw": YAW, "hip_roll": ROLL},
    **{"waist_pitch": PITCH, "waist_roll": ROLL, "shoulder": PITCH, "elbow": PITCH},
}


def first_message(folder, name):
    """What the plant is told of a robot that stands upright, and the robot's URDF as read here."""
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
        "sole": {edge: sole.get(f"{edge}_m", sole.get("width_m", 0) / 2) for edge in EDGES},
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
        "floor": [],
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


def centre_of_mass(robot):
    """In the world."""
    return robot.data.subtree_com[0]
