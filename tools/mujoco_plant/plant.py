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

The robot comes in one of two forms. `"mjcf"` is a complete model of the twenty-joint mechanism (`Robot`). `"urdf"`,
with `"urdf_setup"`, is a vendor's URDF, of which this script makes a model with all joints that it has (`UrdfRobot`):
those that the mechanism has too are driven, the others held by servos. README.md lists what `"urdf_setup"` contains.
"""

import contextlib
import json
import math
import os
import random
import sys
from xml.etree import ElementTree

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
# The joints with motors, the last of the twenty, in the order of setpoints and states.
POWERED = (
    *("right_ankle_roll", "right_ankle_pitch", "right_knee", "right_hip_pitch", "right_hip_yaw", "right_hip_roll"),
    *("left_hip_roll", "left_hip_yaw", "left_hip_pitch", "left_knee", "left_ankle_pitch", "left_ankle_roll"),
    *("waist_pitch", "waist_roll", "right_shoulder", "right_elbow", "left_shoulder", "left_elbow"),
)
SIDES = ("right", "left")

# Contact of soles and floor, as in the exported MJCF: the time constant (s) there, for legs as long as there (m), with
# critical damping; impedance over half a millimetre; torsional and rolling friction, which such contacts do not use.
CONTACT_TIME, CONTACT_LEG = 0.004, 0.926
CONTACT_IMPEDANCE = (0.99, 0.999, 0.0005, 0.5, 2)
UNUSED_FRICTION = (0.005, 0.0001)
# What a contact sensor tells, as bits: force, torque and place. All contacts together give one wrench.
GROUND_DATA, GROUND_NET = 1 << 1 | 1 << 2 | 1 << 4, 3
# Radius of gyration (m) and inertia (kg m2) that a mass has at least: MuJoCo refuses point masses.
GYRATION_MIN, INERTIA_MIN = 1e-4, 1e-12
# Mass of a moving link that weighs nothing, relative to the robot's: MuJoCo refuses those, too.
TINY_MASS = 1e-9


class Robot:
    """The simulated robot, one control period at a time."""

    def __init__(self, told):
        self.model = self._load(told)
        self.data = mujoco.MjData(self.model)
        self.steps = told["steps_per_period"]
        self.step_s = told["period_s"] / self.steps
        self.model.opt.timestep = self.step_s
        self.pushes = told["pushes"]
        self.periods = 0

        names = [self._joint(name) for name in told["joints"]]
        powered = [self.model.joint(name) for name, _ in names]
        self.qpos = np.array([joint.qposadr[0] for joint in powered])
        self.dofs = np.array([joint.dofadr[0] for joint in powered])
        self.actuators = np.array([self.model.actuator(name).id for name, _ in names])
        self.powered = np.array([JOINTS - len(POWERED) + POWERED.index(name) for name in told["joints"]])
        # Where the model's joint turns the other way, -1.
        self.signs = np.array([sign for _, sign in names])
        self._set_drives(told)
        self._set_state(told["start"])

        self.setpoint = np.zeros((3, JOINTS))
        self.state = np.zeros(STATE)
        self.grounds = [self.model.sensor(f"{side}_ground").adr[0] for side in SIDES]

    def _load(self, told):
        return mujoco.MjModel.from_xml_string(told["mjcf"])

    def _joint(self, name):
        """What the model calls one of the twenty joints, and 1, or -1 if it turns the other way."""
        return name, 1.0

    def _set_drives(self, told):
        """Turns torque motors into drives."""
        stiffness, damping, back_emf = (np.array(told[key]) for key in ("stiffness", "damping", "back_emf"))
        self.stiffness, self.damping = stiffness, damping
        bias = self.model.actuator_biasprm
        self.model.actuator_biastype[self.actuators] = mujoco.mjtBias.mjBIAS_AFFINE
        bias[self.actuators, 1] = -stiffness
        bias[self.actuators, 2] = -(damping + self.step_s * stiffness) + back_emf
        self.model.dof_damping[self.dofs] += back_emf
        self.back_emf = back_emf

    def _set_state(self, start):
        self.data.qpos[self.qpos] = self.signs * np.array(start["angles"])[self.powered]
        self.data.qvel[self.dofs] = self.signs * np.array(start["rates"])[self.powered]
        self._set_sole(start)
        mujoco.mj_forward(self.model, self.data)

    def _set_sole(self, start):
        """Gives the right sole its place and velocity. Here it is what the free joint carries."""
        data = self.data
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, np.array(start["orientation"]))
        data.qpos[0:3] = start["position"]
        data.qpos[3:7] = start["orientation"]
        data.qvel[0:3] = start["velocity"]
        data.qvel[3:6] = rotation.reshape(3, 3).T @ start["angular_rate"]

    def advance(self):
        """Moves on by one control period towards `setpoint`, and fills `state`."""
        angles, rates, feed_forward = self.setpoint[:, self.powered]
        data = self.data
        for number in range(self.steps):
            lead = (self.steps - 1 - number) * self.step_s
            target = angles - lead * rates
            data.ctrl[self.actuators] = self.signs * (self.stiffness * target + self.damping * rates + feed_forward)
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
                body, point = self._pushed(push["body"])
                mujoco.mj_applyFT(self.model, data, force, np.zeros(3), point, body, data.qfrc_applied)

    def _pushed(self, name):
        """The body of a link, and the link's centre of mass in the world."""
        body = self.model.body(name).id
        return body, self.data.xipos[body]

    def _tell(self):
        data, state = self.data, self.state
        state[13:33][self.powered] = self.signs * data.qpos[self.qpos]
        state[33:53][self.powered] = self.signs * data.qvel[self.dofs]
        origin = self._sole_origin()
        for place, sensor in zip((53, 59), self.grounds):
            force, moment, point = data.sensordata[sensor : sensor + 9].reshape(3, 3)
            # The sensor's point and the right sole's place are both of the step's beginning.
            state[place : place + 3] = force
            state[place + 3 : place + 6] = moment + np.cross(point - origin, force)
        torques = data.qfrc_actuator[self.dofs] - self.back_emf * data.qvel[self.dofs]
        state[65:85][self.powered] = self.signs * torques
        self._tell_sole()

    def _sole_origin(self):
        """The right sole's origin, as of the beginning of the last step."""
        return self.data.xpos[1]

    def _tell_sole(self):
        data, state = self.data, self.state
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, data.qpos[3:7])
        state[0:7] = data.qpos[0:7]
        state[7:10] = rotation.reshape(3, 3) @ data.qvel[3:6]
        state[10:13] = data.qvel[0:3]


class UrdfRobot(Robot):
    """A robot as its vendor's URDF describes it. The free joint carries the URDF's root link."""

    def _load(self, told):
        setup = told["urdf_setup"]
        self.urdf_joints = {joint["role"]: (joint["urdf"], float(joint["sign"])) for joint in setup["joints"]}
        if set(self.urdf_joints) != set(told["joints"]):
            raise ValueError("joints and urdf_setup.joints are not of the same joints")
        built = UrdfModel(told["urdf"], setup, told["period_s"] / told["steps_per_period"])
        self.pushable = {name: (built.model.body(body).id, centre) for name, (body, centre) in built.pushable.items()}
        if unknown := {push["body"] for push in told["pushes"]} - set(self.pushable):
            raise ValueError(f"a push acts on {', '.join(sorted(unknown))}, which this robot does not have")
        self.held = [(built.model.joint(each["urdf"]).qposadr[0], each["at"]) for each in setup["held"]]
        self.sole = built.model.site("right_sole").id
        self.foot = built.model.site_bodyid[self.sole]
        return built.model

    def _joint(self, name):
        return self.urdf_joints[name]

    def _set_sole(self, start):
        model, data = self.model, self.data
        for qpos, angle in self.held:
            data.qpos[qpos] = angle
        # First the root rests at the world's origin, to see where the sole is and how it moves.
        data.qpos[0:7] = (0, 0, 0, 1, 0, 0, 0)
        data.qvel[0:6] = 0
        self._move()
        position, orientation, rate, velocity = self._sole_motion()
        back, root, turn = np.zeros(4), np.zeros(4), np.zeros(9)
        mujoco.mju_negQuat(back, orientation)
        mujoco.mju_mulQuat(root, np.array(start["orientation"], dtype=float), back)
        mujoco.mju_normalize4(root)
        mujoco.mju_quat2Mat(turn, root)
        turn = turn.reshape(3, 3)
        arm = turn @ position
        root_rate = np.array(start["angular_rate"]) - turn @ rate
        data.qpos[0:3] = np.array(start["position"]) - arm
        data.qpos[3:7] = root
        data.qvel[0:3] = np.array(start["velocity"]) - turn @ velocity - np.cross(root_rate, arm)
        data.qvel[3:6] = turn.T @ root_rate

    def _move(self):
        """Brings places and velocities of all bodies up to date."""
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_comVel(self.model, self.data)

    def _sole_motion(self):
        """Place, orientation, angular rate and velocity of the right sole, in world axes."""
        model, data = self.model, self.data
        orientation, motion = np.zeros(4), np.zeros(6)
        mujoco.mju_mulQuat(orientation, data.xquat[self.foot], model.site_quat[self.sole])
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_SITE, self.sole, motion, 0)
        return data.site_xpos[self.sole].copy(), orientation, motion[0:3], motion[3:6]

    def _pushed(self, name):
        body, local = self.pushable[name]
        return body, self.data.xpos[body] + self.data.xmat[body].reshape(3, 3) @ local

    def _sole_origin(self):
        return self.data.site_xpos[self.sole]

    def _tell_sole(self):
        self._move()
        state = self.state
        state[0:3], state[3:7], state[7:10], state[10:13] = self._sole_motion()


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


class UrdfModel:
    """MuJoCo's model of a robot from its URDF, on a floor.

    Joints and their actuators have the URDF's names. `pushable` holds, by the mechanism's name of a link, its body's
    name and its centre of mass, without payload, in the body's frame.
    """

    def __init__(self, text, setup, step_s):
        wrong, seed = (setup["mass_error"][key] for key in ("share", "seed"))
        errors = random.Random(seed)
        self.urdf = Urdf(text, lambda: 1 + errors.uniform(-wrong, wrong))
        self.setup, self.step_s = setup, step_s
        self.spec = mujoco.MjSpec.from_string(self.urdf.text())
        self._set_options()
        self.spec.body(self.urdf.bodies[self.urdf.root]).add_freejoint(name=unique([*self.urdf.moving, "root"])[-1])
        self._set_joints()

        # The posture in which the setup gives places: driven joints at 0, the root at the world's origin.
        self.model = self.spec.compile()
        self.data = mujoco.MjData(self.model)
        for held in setup["held"]:
            self.data.qpos[self.model.joint(held["urdf"]).qposadr[0]] = held["at"]
        mujoco.mj_kinematics(self.model, self.data)
        self.from_ahead = np.zeros(4)
        mujoco.mju_negQuat(self.from_ahead, np.array(setup["to_ahead"], dtype=float))
        mujoco.mju_normalize4(self.from_ahead)

        feet = {side: self._link(setup["feet"][side]["joint"], 1) for side in SIDES}
        trunk = self.urdf.carrier(setup["trunk_link"])
        self.pushable = {
            name: (self.urdf.bodies[link], self._centre_of_mass(self.urdf.bodies[link]))
            for name, link in self._pushable(feet, trunk).items()
        }
        self._add_floor_and_soles(feet)
        self._add_payload(trunk)
        self.spec.compiler.fusestatic = True
        self.model = self.spec.compile()

    def _set_options(self):
        option = self.spec.option
        option.timestep, option.gravity = self.step_s, self.setup["gravity"]
        option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        option.cone, option.impratio = mujoco.mjtCone.mjCONE_ELLIPTIC, 10
        option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
        self.spec.compiler.inertiafromgeom = mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_FALSE

    def _set_joints(self):
        """Motors for the driven joints, which become drives later, and servos for those that are held."""
        driven, held, bearing = self.setup["joints"], self.setup["held"], self._bearing()
        told = [joint["urdf"] for joint in [*driven, *held]]
        if twice := {name for name in told if told.count(name) > 1}:
            raise ValueError(f"urdf_setup has {', '.join(sorted(twice))} twice")
        if unknown := set(told) - set(self.urdf.moving):
            raise ValueError(f"there is no moving joint {', '.join(sorted(unknown))}")
        if untold := set(self.urdf.moving) - set(told):
            raise ValueError(f"urdf_setup does not say what {', '.join(sorted(untold))} does")
        for joint in driven:
            if joint["sign"] not in (1, -1):
                raise ValueError(f"the sign of {joint['role']} is {joint['sign']}, not 1 or -1")
            self._set_joint(joint)
            if "range" in joint:
                self._set_range(joint["urdf"], joint["range"])
        for joint in held:
            actuator = self._set_joint({"effort": self.urdf.efforts.get(joint["urdf"]), **joint})
            self._set_range(joint["urdf"], None)
            servo = self.setup["servo"]["legs_and_waist" if joint["urdf"] in bearing else "arms"]
            stiffness, damping = servo["stiffness"], servo["damping"]
            # A drive with a constant target, evaluated at the end of the step.
            actuator.gainprm[0] = 0
            actuator.biasprm[0:3] = stiffness * joint["at"], -stiffness, -(damping + self.step_s * stiffness)

    def _bearing(self):
        """The joints between the feet and the trunk, whose drives carry the robot."""
        feet = [self._link(self.setup["feet"][side]["joint"], 1) for side in SIDES]
        trunk = self.urdf.carrier(self.setup["trunk_link"])
        return set().union(*(self.urdf.between(foot, trunk) for foot in feet))

    def _set_joint(self, told):
        """Sets what driven and held joints have in common. Returns the actuator."""
        self.spec.joint(told["urdf"]).armature = told.get("armature", 0.0)
        actuator = self.spec.add_actuator(name=told["urdf"], target=told["urdf"], trntype=mujoco.mjtTrn.mjTRN_JOINT)
        actuator.biastype = mujoco.mjtBias.mjBIAS_AFFINE
        actuator.ctrllimited = mujoco.mjtLimited.mjLIMITED_FALSE
        if (effort := told["effort"]) is not None:
            if effort <= 0:
                raise ValueError(f"the effort of {told['urdf']} is {effort}")
            actuator.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE
            actuator.forcerange = -effort, effort
        return actuator

    def _set_range(self, name, limits):
        joint = self.spec.joint(name)
        joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE if limits is None else mujoco.mjtLimited.mjLIMITED_TRUE
        joint.range = (0, 0) if limits is None else limits

    def _link(self, joint, end):
        """The link that a joint is mounted on (0) or that it moves (1)."""
        if joint not in self.urdf.moving:
            raise ValueError(f"there is no moving joint {joint}")
        return self.urdf.moving[joint][end]

    def _pushable(self, feet, trunk):
        """The links that the mechanism has a name for."""
        links = {"trunk": trunk, **{f"{side}_foot": foot for side, foot in feet.items()}}
        joints = {joint["role"]: joint["urdf"] for joint in self.setup["joints"]}
        for side in SIDES:
            for joint, above, below in (("knee", "thigh", "shank"), ("elbow", "upper_arm", "forearm")):
                if (name := joints.get(f"{side}_{joint}")) is not None:
                    links[f"{side}_{above}"] = self.urdf.carrier(self._link(name, 0))
                    links[f"{side}_{below}"] = self._link(name, 1)
        if hips := self._hips():
            links["pelvis"] = self.urdf.carrier(self._link(min(hips, key=self._depth), 0))
        return links

    def _hips(self):
        """The URDF's names of the right hip's joints."""
        return [joint["urdf"] for joint in self.setup["joints"] if joint["role"].startswith("right_hip_")]

    def _depth(self, joint):
        """The number of links between a joint and the root."""
        link, depth = self._link(joint, 0), 0
        while link in self.urdf.parents:
            link, depth = self.urdf.parents[link][0], depth + 1
        return depth

    def _centre_of_mass(self, body):
        """Of a body with all that is fixed to it, in its frame."""
        model, data, number = self.model, self.data, self.model.body(body).id
        welded = model.body_weldid == number
        masses = model.body_mass[welded]
        return data.xmat[number].reshape(3, 3).T @ (masses @ data.xipos[welded] / masses.sum() - data.xpos[number])

    def _within(self, body, place):
        """A place in the root's coordinates, in those of a body."""
        number = self.model.body(body).id
        return self.data.xmat[number].reshape(3, 3).T @ (np.array(place) - self.data.xpos[number])

    def _height(self, place):
        """How far a place is above the right sole."""
        upward = np.zeros(3)
        mujoco.mju_rotVecQuat(upward, np.array([0, 0, 1.0]), self.from_ahead)
        return upward @ (np.array(place) - self.setup["soles"]["right"])

    def contact_time(self):
        """The contacts' time constant: as long, relative to the time that a leg takes to fall over, as in the MJCF."""
        if (told := self.setup.get("contact_time")) is not None:
            return told
        hips = [self._height(self.data.xanchor[self.model.joint(name).id]) for name in self._hips()]
        leg = max(hips, default=CONTACT_LEG)
        # MuJoCo takes no time constant shorter than two steps.
        return max(CONTACT_TIME * math.sqrt(max(leg, 0) / CONTACT_LEG), 2 * self.step_s)

    def _add_floor_and_soles(self, feet):
        sole, contact_time = self.setup["sole"], self.contact_time()
        contact = {
            "condim": 3,
            "friction": (self.setup["friction"], *UNUSED_FRICTION),
            "solref": (contact_time, 1),
            "solimp": CONTACT_IMPEDANCE,
            "mass": 0,
        }
        plane, box = mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_BOX
        self.spec.worldbody.add_geom(name="floor", type=plane, size=(0, 0, 0.5), contype=1, conaffinity=0, **contact)
        for side, foot in feet.items():
            body = self.spec.body(self.urdf.bodies[foot])
            number = self.model.body(body.name).id
            at, turn, back = self._within(body.name, self.setup["soles"][side]), np.zeros(4), np.zeros(4)
            mujoco.mju_negQuat(back, self.data.xquat[number])
            mujoco.mju_mulQuat(turn, back, self.from_ahead)
            # Half as high as the ankle. Only the lower face matters.
            ankle = self._height(self.data.xanchor[self.model.joint(self.setup["feet"][side]["joint"]).id])
            height = max(ankle, 0.1 * sole["half_width"]) / 2
            centre = np.zeros(3)
            mujoco.mju_rotVecQuat(centre, np.array([(sole["ahead"] - sole["behind"]) / 2, 0, height / 2]), turn)
            half = ((sole["ahead"] + sole["behind"]) / 2, sole["half_width"], height / 2)
            name, place = f"{side}_foot_on_floor", at + centre
            body.add_geom(name=name, type=box, pos=place, quat=turn, size=half, contype=0, conaffinity=1, **contact)
            body.add_site(name=f"{side}_sole", pos=at, quat=turn)
            self.spec.add_sensor(
                name=f"{side}_ground",
                type=mujoco.mjtSensor.mjSENS_CONTACT,
                objtype=mujoco.mjtObj.mjOBJ_GEOM,
                objname="floor",
                reftype=mujoco.mjtObj.mjOBJ_GEOM,
                refname=name,
                intprm=(GROUND_DATA, GROUND_NET, 1),
            )

    def _add_payload(self, trunk):
        payload = self.setup["payload"]
        if payload["mass"] > 0:
            body = self.urdf.bodies[trunk]
            name = unique([*self.urdf.bodies.values(), "payload"])[-1]
            added = self.spec.body(body).add_body(name=name, pos=self._within(body, payload["at"]))
            added.mass, added.ipos, added.inertia = payload["mass"], (0, 0, 0), (1e-9, 1e-9, 1e-9)
            added.explicitinertial = True


def main():
    """Answers setpoints with states until there are no more."""
    told = json.loads(sys.stdin.buffer.readline())
    if told["protocol"] != PROTOCOL:
        sys.exit(f"halfstep speaks engine protocol {told['protocol']}, this MuJoCo plant {PROTOCOL}")
    try:
        robot = UrdfRobot(told) if "urdf" in told else Robot(told)
    except (ValueError, ElementTree.ParseError) as error:
        sys.exit(f"MuJoCo cannot load the robot: {error}")
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
