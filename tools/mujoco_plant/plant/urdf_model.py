"""MuJoCo's model of a robot from its URDF: joints with their actuators, a floor, and soles."""

import math
import random

import mujoco
import numpy as np

from .protocol import SIDES
from .urdf import Urdf, unique

# Contact of soles and floor, as in the exported MJCF: the time constant (s) there, for legs as long as there (m), with
# critical damping; impedance over half a millimetre; torsional and rolling friction, which such contacts do not use.
CONTACT_TIME, CONTACT_LEG = 0.004, 0.926
CONTACT_IMPEDANCE = (0.99, 0.999, 0.0005, 0.5, 2)
UNUSED_FRICTION = (0.005, 0.0001)
# What a contact sensor tells, as bits: force, torque and place. All contacts together give one wrench.
GROUND_DATA, GROUND_NET = 1 << 1 | 1 << 2 | 1 << 4, 3


class UrdfModel:
    """MuJoCo's model of a robot from its URDF, on a plane or on no floor yet.

    Joints and their actuators have the URDF's names. `pushable` holds, by the mechanism's name of a link, its body's
    name and its centre of mass, without payload, in the body's frame.
    """

    def __init__(self, text, setup, step_s, is_plane=True):
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
        self._add_soles(feet)
        if is_plane:
            self._add_floor()
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

    def _contact(self):
        return {
            "condim": 3,
            "friction": (self.setup["friction"], *UNUSED_FRICTION),
            "solref": (self.contact_time(), 1),
            "solimp": CONTACT_IMPEDANCE,
            "mass": 0,
        }

    def _add_floor(self):
        plane = mujoco.mjtGeom.mjGEOM_PLANE
        world = self.spec.worldbody
        world.add_geom(name="floor", type=plane, size=(0, 0, 0.5), contype=1, conaffinity=0, **self._contact())

    def _add_soles(self, feet):
        sole, contact, box = self.setup["sole"], self._contact(), mujoco.mjtGeom.mjGEOM_BOX
        for side, foot in feet.items():
            body = self.spec.body(self.urdf.bodies[foot])
            number = self.model.body(body.name).id
            at, turn, back = self._within(body.name, self.setup["soles"][side]), np.zeros(4), np.zeros(4)
            mujoco.mju_negQuat(back, self.data.xquat[number])
            mujoco.mju_mulQuat(turn, back, self.from_ahead)
            # Half as high as the ankle. Only the lower face matters.
            ankle = self._height(self.data.xanchor[self.model.joint(self.setup["feet"][side]["joint"]).id])
            # The right foot's inner edge is its left one.
            left, right = (sole[edge] for edge in (("inside", "outside") if side == "right" else ("outside", "inside")))
            height = max(ankle, 0.05 * (left + right)) / 2
            centre = np.zeros(3)
            middle = ((sole["ahead"] - sole["behind"]) / 2, (left - right) / 2, height / 2)
            mujoco.mju_rotVecQuat(centre, np.array(middle), turn)
            half = ((sole["ahead"] + sole["behind"]) / 2, (left + right) / 2, height / 2)
            name, place = f"{side}_foot_on_floor", at + centre
            body.add_geom(name=name, type=box, pos=place, quat=turn, size=half, contype=0, conaffinity=1, **contact)
            body.add_site(name=f"{side}_sole", pos=at, quat=turn)
            self.spec.add_sensor(
                name=f"{side}_ground",
                type=mujoco.mjtSensor.mjSENS_CONTACT,
                objtype=mujoco.mjtObj.mjOBJ_BODY,
                objname="world",
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
