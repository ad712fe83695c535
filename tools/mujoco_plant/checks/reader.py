"""A URDF, read without MuJoCo: what the models are compared with."""

import math
from xml.etree import ElementTree

import numpy as np

# Axes of the standing robot: x ahead, y left, z up.
ROLL, PITCH, YAW = np.eye(3)


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
