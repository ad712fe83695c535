"""The wheel, as it is installed: walks within a process, batches of them, and the program beside them.

python -m unittest discover tools/python/tests          HALFSTEP_LONG=1 for five seeds of 60 s instead of one of 8 s
"""

import contextlib
import io
import json
import math
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import unittest
from pathlib import Path

import numpy as np

import halfstep
from halfstep import BadInput, Batch, Footstep, Mode, Side, Verdict, Walk, Waypoint

PROGRAM = Path(sysconfig.get_path("scripts")) / "halfstep"
DOCUMENTATION = Path(__file__).parents[3] / "docs" / "python.md"
EXAMPLE = Path(__file__).parent.parent / "examples" / "walk_in_this_process.py"
LONG = bool(os.environ.get("HALFSTEP_LONG"))
SECONDS, SEEDS = (60, range(5)) if LONG else (8, range(3, 4))

COMMANDS = """{"t":1,"intent":"walk"}
{"t":3,"turn_deg":8,"speed":1.05}
{"t":5.5,"vx":0.1,"vy":0.04}
"""
DISTURBANCES = "[[push]]\nat_s = 4.3\nlasts_s = 0.1\nimpulse_n_s = [3, 2, 0]\n"


def program(folder, *words):
    told = subprocess.run([PROGRAM, *map(str, words)], cwd=folder, capture_output=True, text=True, check=False)
    assert told.returncode == 0, told.stderr
    return told.stdout


class TheWheel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_ten_lines_walk_a_robot_for_a_minute_and_draw_its_zmp(self):
        told = subprocess.run(
            [sys.executable, EXAMPLE, "g1", "zmp.png"], cwd=self.folder, capture_output=True, text=True, check=False
        )
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn("fell: False", told.stdout)
        self.assertGreater((self.folder / "zmp.png").stat().st_size, 10_000)

    def test_what_the_documentation_shows_runs(self):
        blocks = re.findall(r"```python\n(.*?)```", DOCUMENTATION.read_text(), re.DOTALL)
        self.assertEqual(len(blocks), 2)
        for block in blocks:
            told = io.StringIO()
            with contextlib.redirect_stdout(told):
                exec(compile(block, DOCUMENTATION.name, "exec"), {})
            self.assertGreater(len(told.getvalue().splitlines()), 0, block)

    def test_a_walk_has_the_bits_of_two_processes(self):
        (self.folder / "my.jsonl").write_text(COMMANDS)
        (self.folder / "my.toml").write_text(DISTURBANCES)
        for robot in ("paper", "g1"):
            for seed in SEEDS:
                for from_stand in (True, False):
                    with self.subTest(robot=robot, seed=seed, from_stand=from_stand):
                        start = ["--from-stand"] if from_stand else []
                        words = ["--commands", "my.jsonl", "--disturbances", "my.toml", "--for", f"{SECONDS}s", *start]
                        by_program = json.loads(
                            program(self.folder, "walk", "--lockstep", "--robot", robot, "--seed", seed, "--json", *words)
                        )
                        files = {"commands": self.folder / "my.jsonl", "disturbances": self.folder / "my.toml"}
                        walk = Walk(robot, seed=seed, from_stand=from_stand, **files)
                        if from_stand:  # The program asks for that by itself.
                            (self.folder / "from_stand.jsonl").write_text('{"t":0,"intent":"walk"}\n' + COMMANDS)
                            files["commands"] = self.folder / "from_stand.jsonl"
                            walk = Walk(robot, seed=seed, **files)
                        walk.run(SECONDS)
                        self.assertEqual(walk.setpoint_hash, by_program["setpoint_hash"])
                        self.assertFalse(walk.state.fallen)

    def test_a_batch_has_the_bits_of_its_walks(self):
        batch = Batch("limx", [7, 1, 7], threads=2)
        batch.ask(vx=[0.1, 0.2, 0.0], vy=[0.0, 0.0, 0.05], which=[True, True, True])
        batch.push([[0, 0, 0], [1.5, 0, 0], [0, 0, 0]])
        batch.step(3000)
        for place, (seed, velocity, push) in enumerate(
            [(7, {"vx": 0.1}, 0), (1, {"vx": 0.2}, 1.5), (7, {"vx": 0.0, "vy": 0.05}, 0)]
        ):
            walk = Walk("limx", seed=seed)
            if push:
                walk.push([push, 0, 0])
            walk.ask(**velocity)
            walk.step(3000 - walk.tick)
            self.assertEqual(walk.setpoint_hash, batch.setpoint_hashes[place])
            np.testing.assert_array_equal(walk.state.rows, batch.states[place].rows)
        self.assertEqual([reply.verdict for reply in batch.replies], [Verdict.ACCEPTED] * 3)

    def test_a_walk_goes_on_from_where_it_was_saved(self):
        walk = Walk(seed=2)
        walk.ask(speed=1.1, intent="walk")
        walk.run(3)
        saved = walk.save()
        first = walk.run(2)
        walk.restore(saved)
        np.testing.assert_array_equal(walk.run(2).rows, first.rows)
        batch = Batch(None, 2)
        batch.restore(1, saved)
        batch.step(2000)
        np.testing.assert_array_equal(batch.states[1].rows, first[-1].rows)
        self.assertEqual(walk.seed, 2)
        walk.reset()
        self.assertEqual((walk.tick, walk.seed), (0, 2))

    def test_states_are_views_in_the_units_that_are_told(self):
        walk = Walk()
        self.assertTrue(np.isnan(walk.state.margin), "nothing was reported yet")
        self.assertIsNone(walk.state.mode)
        walk.ask(intent="walk")
        trace = walk.run(4, every=0.02)
        self.assertEqual(len(trace), 200)
        self.assertAlmostEqual(trace.time[-1], 4.001)
        self.assertIs(trace.zmp.base, trace.rows if trace.rows.base is None else trace.rows.base)
        self.assertEqual(walk.state.mode, Mode.WALKING)
        # Newton: the soles bear the weight on average.
        weight = trace.loads[50:].sum(axis=1).mean() / 9.80665
        self.assertAlmostEqual(weight, 73.03, delta=3)
        # The derivative of the centre of mass is its velocity.
        derivative = np.gradient(trace.com[:, 0], 0.02)[20:-1]
        self.assertLess(np.abs(derivative - trace.com_velocity[20:-1, 0]).max(), 0.1)
        self.assertLess(np.abs(trace.angles - trace.measured_angles).max(), 0.01)

    def test_parameters_are_those_of_the_files(self):
        ice, floor = (Walk(parameters={"plant.contact.friction": friction}, seed=1) for friction in (0.05, 0.8))
        for walk in (ice, floor):
            walk.ask(intent="walk")
            walk.run(5)
        self.assertTrue(ice.state.fallen and not floor.state.fallen)
        batch = Batch(None, [1, 1], parameters=[{"plant.contact.friction": 0.05}, {}])
        batch.ask(intent="walk")
        batch.step(5001)
        np.testing.assert_array_equal(batch.states.fallen, [True, False])
        self.assertEqual(batch.setpoint_hashes[1], floor.setpoint_hash)
        config = Path(__file__).parents[3] / "config"
        if config.is_dir():
            folder = Walk(config=config, seed=1)
            folder.ask(intent="walk")
            folder.run(5)
            self.assertEqual(folder.setpoint_hash, floor.setpoint_hash)

    def test_destinations_are_reached(self):
        walk = Walk("op3")
        reply = walk.ask(goto=Waypoint(0.3, 0.1, 20))
        self.assertEqual(reply.verdict, Verdict.ACCEPTED, reply.text)
        walk.run(reply.granted["arrival_s"] + 3)
        x, y, heading = walk.state.estimated_pose
        self.assertLess(math.hypot(x - 0.3, y - 0.1), 0.02)
        self.assertAlmostEqual(math.degrees(heading), 20, delta=2)
        self.assertFalse(walk.ask(footsteps=[Footstep(Side.LEFT, 9, 0, 0)], relative=True).accepted)

    def test_what_is_wrong_is_named(self):
        walk, batch = Walk(), Batch(None, 2)
        for wrong, told in [
            (lambda: Walk("g2"), 'robot = "g2": must be one of paper, g1'),
            (lambda: Walk(config="/nowhere"), "/nowhere/mechanism.toml: cannot be read"),
            (lambda: Walk("g1", config="."), "robot, config, urdf: give one of them"),
            (lambda: Walk(rate_hz=3), "rate_hz = 3: must be 250 to 4000"),
            (lambda: Walk(parameters={"plant.contact.friktion": 1}), "friktion = 1: unknown key"),
            (lambda: Walk(parameters={"friction": 1}), '"friction" must begin with controller, plant or mechanism'),
            (lambda: Walk(parameters={"plant.contact.friction": -1}), "friction = -1: must lie between"),
            (lambda: Walk(parameters={"plant.contact.friction": object()}), "must be a flag, a number, a text"),
            (lambda: walk.ask(), "no command"),
            (lambda: walk.ask(vx=math.nan), "vx = nan: must be a finite number"),
            (lambda: walk.ask(vx=1, speed=1), "a velocity and gait parameters"),
            (lambda: walk.ask(intent="fly"), 'intent = "fly": must be one of'),
            (lambda: walk.run(0), "seconds = 0: must be at least a period"),
            (lambda: walk.push([math.inf, 0, 0]), "a push must last 1 ms to 10 s"),
            (lambda: walk.push([1, 0, 0], link="tail"), 'link = "tail": must be one of'),
            (lambda: batch.restore(2, walk.save()), "place = 2: there are 2 walks"),
            (lambda: Batch(None, 2, parameters=[{}]), "parameters: one for each of the 2 walks"),
        ]:
            with self.assertRaises(BadInput) as caught:
                wrong()
            self.assertIn(told, str(caught.exception))
            self.assertIsInstance(caught.exception, (ValueError, halfstep.HalfstepError))
        self.assertEqual(walk.tick, 0, "nothing of that has moved the robot")


if __name__ == "__main__":
    unittest.main()
