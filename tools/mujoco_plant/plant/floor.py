"""The floor under the robot, where it is no plane: convex bodies, laid out anew where the robot has come to others."""

import mujoco

# What the names of its bodies begin with.
PREFIX = "floor_"


class Floor:
    """Bodies in a model's world, each with the friction of its own and otherwise in contact as a sole is."""

    def __init__(self, spec, sole):
        self.spec, self.sole = spec, spec.geom(sole)
        self.names = []

    def lay(self, bodies):
        """Puts bodies in the place of those that are there. The model must be compiled anew."""
        for name in self.names:
            self.spec.delete(self.spec.geom(name))
            self.spec.delete(self.spec.mesh(name))
        self.names = [f"{PREFIX}{number}" for number in range(len(bodies))]
        for name, body in zip(self.names, bodies):
            self.spec.add_mesh(name=name, uservert=[each for vertex in body["vertices"] for each in vertex])
            self.spec.worldbody.add_geom(
                name=name,
                type=mujoco.mjtGeom.mjGEOM_MESH,
                meshname=name,
                pos=body["at"],
                contype=1,
                conaffinity=0,
                condim=3,
                # The friction is the floor's, not the larger one of floor and sole.
                priority=1,
                friction=(body["friction"], *self.sole.friction[1:]),
                solref=self.sole.solref,
                solimp=self.sole.solimp,
            )
