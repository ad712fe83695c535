"""Peculiarities that other URDFs have: roots, links and joints of every kind, and what is refused."""

import math
from xml.etree import ElementTree

import mujoco
import numpy as np

import plant

from .reader import Reader
from .told import at_once, centre_of_mass, start


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
    for period in range(periods):
        for robot in robots:
            robot.advance(period)
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
    for period in range(300):
        robot.advance(period)
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
