"""A URDF in a form that MuJoCo's own loader takes."""

from xml.etree import ElementTree

import numpy as np

# Radius of gyration (m) and inertia (kg m2) that a mass has at least: MuJoCo refuses point masses.
GYRATION_MIN, INERTIA_MIN = 1e-4, 1e-12
# Mass of a moving link that weighs nothing, relative to the robot's: MuJoCo refuses those, too.
TINY_MASS = 1e-9


class Urdf:
    """Links and joints of a URDF, in a form that MuJoCo's own loader takes.

    Shapes, meshes and extensions are left out. A floating joint of the root becomes fixed, since the root itself gets a
    free joint. Moving links without mass get a tiny one, and inertias that no body can have become the next possible
    ones. Names are unique. Each link's mass, and independently its inertia, is a `factor()` of what the URDF says.
    """

    def __init__(self, text, factor=lambda: 1.0):
        told = ElementTree.fromstring(text)
        self.factor = factor
        links, joints = told.findall("link"), told.findall("joint")
        names = [link.get("name") for link in links]
        if twice := {name for name in names if names.count(name) > 1}:
            raise ValueError(f"several links are called {', '.join(sorted(twice))}")
        # MuJoCo's name for each link: whatever is called `world` would be the world.
        self.bodies = dict(zip(names, unique(["world", *names])[1:]))
        # By the child link: parent link and joint. By the name of a joint that moves: parent and child link, and how
        # strong it is, where that is told.
        self.parents, self.moving, self.efforts = {}, {}, {}
        self.robot = ElementTree.Element("robot", name=told.get("name") or "robot")
        extension = ElementTree.SubElement(self.robot, "mujoco")
        # Static bodies are fused later, once the root has its free joint.
        ElementTree.SubElement(extension, "compiler", fusestatic="false", balanceinertia="false")
        for link in links:
            self._add_link(link)
        names = [joint.get("name") for joint in joints]
        for joint, name in zip(joints, unique(names)):
            self._add_joint(joint, name)
        if twice := {name for name in names if names.count(name) > 1} & set(self.moving):
            raise ValueError(f"several joints are called {', '.join(sorted(twice))}")
        roots = [name for name in self.bodies if name not in self.parents]
        if len(roots) != 1:
            raise ValueError(f"a robot has one root link, this one {len(roots)}: {', '.join(roots)}")
        self.root = roots[0]
        for joint in self.robot.findall("joint[@type='floating']"):
            if joint.find("parent").get("link") != self.bodies[self.root]:
                raise ValueError(f"joint {joint.get('name')} is floating, but not at the root")
            joint.set("type", "fixed")
        self._give_mass()

    def text(self):
        """The URDF for MuJoCo."""
        return ElementTree.tostring(self.robot, encoding="unicode")

    def carrier(self, link):
        """The link that moves this one: itself, or the one that it is fixed to."""
        if link not in self.bodies:
            raise ValueError(f"there is no link {link}")
        while link in self.parents and self.parents[link][1] not in self.moving:
            link = self.parents[link][0]
        return link

    def between(self, link, other):
        """The joints on the way from one link to another."""
        ways = [set(), set()]
        for way, at in zip(ways, (link, other)):
            while at in self.parents:
                at, joint = self.parents[at]
                way.add(joint)
        return ways[0] ^ ways[1]

    def _add_link(self, link):
        added = ElementTree.SubElement(self.robot, "link", name=self.bodies[link.get("name")])
        mass = link.find("inertial/mass")
        if mass is None or (mass := float(mass.get("value"))) == 0:
            return
        inertia = link.find("inertial/inertia")
        told = {} if inertia is None else inertia.attrib
        xx, xy, xz, yy, yz, zz = (float(told.get(key, 0)) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
        inertia = possible(mass, np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
        mass, inertia = mass * self.factor(), inertia * self.factor()
        set_inertial(added, mass, inertia, place_of(link.find("inertial/origin")))

    def _add_joint(self, joint, name):
        kind = joint.get("type")
        parent, child = joint.find("parent").get("link"), joint.find("child").get("link")
        if child in self.parents:
            raise ValueError(f"link {child} hangs on several joints")
        for link in {parent, child} - set(self.bodies):
            raise ValueError(f"joint {name} is at link {link}, which does not exist")
        self.parents[child] = (parent, name)
        added = ElementTree.SubElement(self.robot, "joint", name=name, type=kind)
        ElementTree.SubElement(added, "origin", place_of(joint.find("origin")))
        ElementTree.SubElement(added, "parent", link=self.bodies[parent])
        ElementTree.SubElement(added, "child", link=self.bodies[child])
        if kind in ("revolute", "continuous", "prismatic"):
            self.moving[name] = (parent, child)
            axis, limit, dynamics = (joint.find(tag) for tag in ("axis", "limit", "dynamics"))
            ElementTree.SubElement(added, "axis", xyz="1 0 0" if axis is None else axis.get("xyz", "1 0 0"))
            if limit is not None and float(limit.get("effort", 0)) > 0:
                self.efforts[name] = float(limit.get("effort"))
            # How strong a driven joint is, the setup says; and of one that mimics another, at which angle it is held.
            if limit is not None and kind != "continuous" and {"lower", "upper"} & set(limit.attrib):
                ElementTree.SubElement(added, "limit", lower=limit.get("lower", "0"), upper=limit.get("upper", "0"))
            if dynamics is not None:
                ElementTree.SubElement(added, "dynamics", dynamics.attrib)
        elif kind not in ("fixed", "floating"):
            raise ValueError(f"joint {name} is {kind}, which is not supported")

    def _give_mass(self):
        links = {name: self.robot.find(f"link[{number}]") for number, name in enumerate(self.bodies, 1)}
        total = sum(float(mass.get("value")) for mass in self.robot.iter("mass"))
        heavy = {self.carrier(name) for name, link in links.items() if link.find("inertial") is not None}
        for name, link in links.items():
            if self.carrier(name) == name and name not in heavy:
                mass = TINY_MASS * total
                set_inertial(link, mass, possible(mass, np.zeros((3, 3))), place_of(None))


def unique(names):
    """The names, with a number added to those that are there already."""
    given = []
    for name in names:
        number, fresh = 1, name or "nameless"
        while fresh in given:
            number += 1
            fresh = f"{name}_{number}"
        given.append(fresh)
    return given


def place_of(origin):
    """Attributes of a URDF's `origin`, complete."""
    told = {} if origin is None else origin.attrib
    return {"xyz": told.get("xyz", "0 0 0"), "rpy": told.get("rpy", "0 0 0")}


def set_inertial(link, mass, inertia, place):
    """Adds mass and inertia to a URDF's link."""
    inertial = ElementTree.SubElement(link, "inertial")
    ElementTree.SubElement(inertial, "origin", place)
    ElementTree.SubElement(inertial, "mass", value=repr(float(mass)))
    keys = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    ElementTree.SubElement(inertial, "inertia", {key: repr(float(inertia[place])) for key, place in keys.items()})


def possible(mass, inertia):
    """The inertia, or the next that a body can have: no direction in which its mass has a negative extent."""
    spread = np.trace(inertia) / 2 * np.eye(3) - inertia
    extents, axes = np.linalg.eigh(spread)
    least = max(mass * GYRATION_MIN**2, INERTIA_MIN)
    if extents.min() >= least:
        return inertia
    spread = axes @ np.diag(np.maximum(extents, least)) @ axes.T
    return np.trace(spread) * np.eye(3) - spread
