"""Turns a recording into a Rerun scene: robot, feet, zero-moment point and centre of mass on one timeline.

    pip install -r tools/rerun/requirements.txt
    python tools/rerun/scene.py runs/0001/run.mcap walk.rrd
    rerun walk.rrd

Right is blue, left orange, the zero-moment point black, the centre of mass green, as in Halfstep's own pictures. A sole that
bears is drawn thick, and where it bore it leaves a footprint. Points on the floor are drawn at the height of the sole that
bears most, so also on steps and ramps. After a fall nothing is drawn: only soles touch the ground, the rest would sink in.
The robot is drawn from the mechanism that is attached to the recording.
"""

import argparse
import tomllib
from pathlib import Path

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory

RIGHT, LEFT, ZMP, COM, PLANNED, BODY = (
    (0, 114, 178), (213, 94, 0), (0, 0, 0), (0, 158, 115), (140, 140, 140), (90, 90, 90)
)
BEARS = 50.0
"""A sole with less force on it [N] does not bear."""
TRAIL = 3.0
"""How long paths are seen [s]."""


class Mechanism:
    """The tree of joints, as `mechanism.toml` tells it."""

    def __init__(self, text):
        told = tomllib.loads(text)
        self.joints = told["joint"]
        sole = told["sole"]
        self.ankle_height = sole["ankle_height_m"]
        inside, outside = (sole.get(key, sole.get("width_m", 0) / 2) for key in ("inside_m", "outside_m"))
        self.outlines = [self.outline(sole, *edges) for edges in ((-outside, inside), (-inside, outside))]

    @staticmethod
    def outline(sole, right, left):
        """The corners of a sole between its right and its left edge, in its own frame; the first one twice."""
        behind, ahead = -sole["behind_m"], sole["ahead_m"]
        corners = [[behind, right, 0], [ahead, right, 0], [ahead, left, 0], [behind, left, 0], [behind, right, 0]]
        return np.array(corners)

    def poses(self, right_sole, angles):
        """Rotation and place of each joint's link in the world, with the right sole where it is."""
        poses = {"ground": (rotation(right_sole[3:]), np.array(right_sole[:3]))}
        # The contact's two joints are in the sole's own pose.
        for name, joint in self.joints.items():
            turn, place = poses[joint["parent"]]
            angle = 0.0 if joint["number"] <= 2 else angles[joint["number"] - 1]
            poses[name] = (turn @ about(joint["axis"], angle), place + turn @ np.array(joint["origin_m"], float))
        return poses

    def bones(self, poses):
        """Lines from joint to joint, and out to the hands."""
        ends = {"right_elbow": -0.27, "left_elbow": -0.27, "waist_roll": 0.6}
        for name, joint in self.joints.items():
            if np.any(joint["origin_m"]):
                yield [poses[joint["parent"]][1], poses[name][1]]
            if name in ends:
                turn, place = poses[name]
                yield [place, place + turn @ [0, 0, ends[name]]]

    def soles(self, poses):
        """Rotation and origin of the right and the left sole."""
        turn, ankle = poses["left_ankle_roll"]
        return poses["ground"], (turn, ankle - turn @ [0, 0, self.ankle_height])


def rotation(quaternion):
    """Of a unit quaternion w x y z."""
    w, x, y, z = quaternion
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])


def about(axis, angle):
    """A rotation about one of the coordinate axes."""
    return rotation([np.cos(angle / 2), *(np.sin(angle / 2) * np.array(axis, float))])


class Trail:
    """The path of a point over the last seconds."""

    def __init__(self):
        self.points = []

    def grown(self, time, point):
        """With one more point."""
        self.points = [(t, p) for t, p in self.points if t > time - TRAIL] + [(time, point)]
        return [p for _, p in self.points]


def main():
    """Reads the recording and writes the scene."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("recording", type=Path, help="run.mcap of a run")
    options.add_argument("scene", type=Path, help="where to, e.g. walk.rrd")
    options.add_argument("--every", type=float, default=0.02, metavar="S", help="time between pictures")
    told = options.parse_args()

    rr.init("halfstep")
    rr.save(told.scene)
    # Along at the robot's side; on white, since the zero-moment point is black in all pictures.
    eye = rrb.EyeControls3D(position=[1.5, -3.0, 1.4], look_target=[0.3, 0, 0.7], tracking_entity="world/com")
    views = [rrb.TimeSeriesView(origin=origin) for origin in ("balance", "walk", "load")]
    walk = rrb.Spatial3DView(origin="world", name="robot", background=[255, 255, 255], eye_controls=eye)
    rr.send_blueprint(rrb.Blueprint(
        rrb.Horizontal(walk, rrb.Vertical(*views), column_shares=[3, 2]),
        rrb.TimePanel(timeline="run"),
        collapse_panels=True,
    ))
    rr.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    for side, colour in (("right", RIGHT), ("left", LEFT)):
        rr.log(f"load/{side}", rr.SeriesLines(colors=[colour], names=[f"{side} [N]"]), static=True)
    with told.recording.open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        attached = {file.name: file.data.decode() for file in reader.iter_attachments()}
        draw(reader, Mechanism(attached["mechanism.toml"]), told.every)


def draw(reader, mechanism, every):
    """Logs everything in order of time."""
    soles, due_truth, due_report, trails = None, 0.0, 0.0, {"zmp": Trail(), "com": Trail()}
    footprints, has_fallen = Footprints(mechanism), False
    messages = reader.iter_decoded_messages(topics=["/truth", "/reports"])
    for _, channel, message, decoded in messages:
        time = message.log_time * 1e-9
        rr.set_time("run", duration=time)
        if channel.topic == "/truth":
            has_fallen = has_fallen or bool(decoded.fallen)
        if has_fallen:
            continue
        if channel.topic == "/truth" and time >= due_truth:
            due_truth = time + every - 1e-9
            poses = mechanism.poses(decoded.right_sole, decoded.angles)
            soles = mechanism.soles(poses)
            draw_robot(mechanism, poses, soles, decoded)
            draw_points(decoded, trails, time, height_under(soles, decoded))
            footprints.note(soles, decoded)
        elif channel.topic == "/reports" and time >= due_report and soles is not None:
            due_report = time + every - 1e-9
            draw_report(decoded, soles)


def draw_robot(mechanism, poses, soles, truth):
    """Its bones and its soles."""
    rr.log("world/robot", rr.LineStrips3D(list(mechanism.bones(poses)), colors=[BODY], radii=[0.012]))
    sides = zip(("right", "left"), (RIGHT, LEFT), soles, mechanism.outlines, truth.loads)
    for side, colour, (turn, place), corners, load in sides:
        outline = corners @ turn.T + place
        thick = 0.008 if load > BEARS else 0.002
        rr.log(f"world/sole/{side}", rr.LineStrips3D([outline], colors=[colour], radii=[thick]))
        rr.log(f"load/{side}", rr.Scalars(load))


def height_under(soles, truth):
    """The height of the sole that bears most."""
    return float(soles[int(np.argmax(truth.loads))][1][2])


class Footprints:
    """Where each sole stood, one for every time that it bore."""

    def __init__(self, mechanism):
        self.mechanism, self.bore, self.count = mechanism, [False, False], [0, 0]

    def note(self, soles, truth):
        """A sole that begins to bear leaves a footprint, which follows it until it is lifted."""
        sides = zip(("right", "left"), (RIGHT, LEFT), soles, self.mechanism.outlines, truth.loads)
        for side, (name, colour, (turn, place), corners, load) in enumerate(sides):
            bears = load > BEARS
            if bears:
                self.count[side] += not self.bore[side]
                outline = rr.LineStrips3D([corners @ turn.T + place], colors=[colour], radii=[0.002])
                rr.log(f"world/footprints/{name}/{self.count[side]}", outline)
            self.bore[side] = bears


def draw_points(truth, trails, time, height):
    """Where the ground reaction acts and where the centre of mass is, with the paths they came by."""
    com, floor = np.array(truth.com), np.array([truth.com[0], truth.com[1], height])
    rr.log("world/com", rr.Points3D([com], colors=[COM], radii=[0.035]))
    rr.log("world/com/floor", rr.LineStrips3D([trails["com"].grown(time, floor)], colors=[COM], radii=[0.003]))
    if np.all(np.isfinite(truth.zmp)):
        zmp = np.array([*truth.zmp, height])
        rr.log("world/zmp", rr.Points3D([zmp], colors=[ZMP], radii=[0.018]))
        rr.log("world/zmp/path", rr.LineStrips3D([trails["zmp"].grown(time, zmp)], colors=[ZMP], radii=[0.002]))
    rr.log("walk/trunk_tilt_deg", rr.Scalars(np.degrees(truth.trunk_tilt)))


def draw_report(report, soles):
    """What the controller said of it."""
    if np.all(np.isfinite(report.zmp_planned)):
        turn, place = soles[report.support]
        planned = place + turn @ [*report.zmp_planned, 0]
        rr.log("world/zmp_planned", rr.Points3D([planned], colors=[PLANNED], radii=[0.015]))
    if np.isfinite(report.margin):
        rr.log("balance/margin_mm", rr.Scalars(1e3 * report.margin))
    rr.log("balance/lean_roll_deg", rr.Scalars(np.degrees(report.lean[0])))
    rr.log("balance/lean_pitch_deg", rr.Scalars(np.degrees(report.lean[1])))
    rr.log("walk/speed", rr.Scalars(report.speed))
    rr.log("walk/turn_deg", rr.Scalars(np.degrees(report.turn)))
    rr.log("walk/extension_deg", rr.Scalars(np.degrees(report.extension)))


if __name__ == "__main__":
    main()
