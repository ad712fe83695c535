"""The Gymnasium environments, as they are installed with `halfstep[gym]`."""

import unittest
import warnings

import numpy as np
from gymnasium.utils.env_checker import check_env

from halfstep import BadInput
from halfstep.gym import WalkEnv, WalkVectorEnv


class TheEnvironments(unittest.TestCase):
    def test_the_checker_finds_nothing(self):
        for residual in ("request", "joints"):
            with warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                check_env(WalkEnv("g1", residual, seconds=1.0, push=3.0), skip_render_check=True)
            # Observations are not bounded.
            told = [str(warning.message) for warning in told if "infinity" not in str(warning.message)]
            self.assertEqual(told, [])

    def test_without_an_action_the_walk_is_the_plain_one_and_keeps_its_velocity(self):
        for residual, actions in (("request", 3), ("joints", 18)):
            env = WalkEnv(None, residual, velocity=((0.2, 0.0, 0.0), (0.2, 0.0, 0.0)), seconds=8.0)
            seen, _ = env.reset(seed=4)
            self.assertEqual((seen.shape, env.action_space.shape), ((36,), (actions,)))
            total, over = 0.0, False
            while not over:
                seen, reward, fell, over, info = env.step(np.zeros(actions, np.float32))
                total += reward
                self.assertFalse(fell)
            # A second or so passes before it walks as it was asked to.
            self.assertGreater(total, 6.5)
            np.testing.assert_allclose(info["state"].estimated_velocity[0], 0.2, atol=0.02)
            np.testing.assert_allclose(seen[12:15], [0.2, 0, 0])

    def test_one_seed_is_one_episode_and_a_batch_has_the_same_physics(self):
        def played(seed):
            env = WalkVectorEnv(3, "g1", "joints", seconds=0.5, push=4.0)
            seen, _ = env.reset(seed=seed)
            trace = [seen]
            random = np.random.default_rng(0)
            for _ in range(40):
                seen, reward, fell, over, _ = env.step(random.uniform(-0.2, 0.2, (3, 18)).astype(np.float32))
                trace += [seen, reward, fell, over]
            return trace

        first, again, other = played(1), played(1), played(2)
        for one, same in zip(first, again, strict=True):
            np.testing.assert_array_equal(one, same)
        self.assertTrue(any(np.any(one != not_same) for one, not_same in zip(first, other, strict=True)))
        self.assertTrue(first[4 * 25].all(), "half a second is over")
        self.assertFalse(first[4 * 26].any(), "and the next one has begun")

    def test_a_fall_ends_an_episode_and_costs(self):
        env = WalkEnv(None, "joints", velocity=np.zeros((2, 3)), seconds=6.0, push=200.0)
        env.reset(seed=0)
        rewards = [0.0]
        for _ in range(300):
            _, reward, fell, over, _ = env.step(np.zeros(18, np.float32))
            rewards.append(reward)
            if fell or over:
                break
        self.assertTrue(fell and not over)
        self.assertLess(rewards[-1], -4.0)

    def test_a_wrong_residual_is_named(self):
        with self.assertRaisesRegex(BadInput, 'residual = "torques": must be "request" or "joints"'):
            WalkEnv(None, "torques")


if __name__ == "__main__":
    unittest.main()
