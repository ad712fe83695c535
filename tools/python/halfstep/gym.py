"""Gymnasium environments: a policy that adds a residual to a walk that already walks.

    pip install 'halfstep[gym]'
    env = halfstep.gym.WalkEnv("g1", residual="request")

The walk is asked to follow a velocity, and pushed now and then. An action adds to what is asked for (`"request"`), or
to the angles of the joints (`"joints"`); zero is the plain controller. Observations are what a controller knows:
estimates and measurements, nothing of the truth.

Observation (float32, in this order): the support foot (-1 right, 1 left), the progress of the half-step, whether the
robot steps; centre of mass ahead and aside of the support ankle [m] and its velocity [m/s], and the divergent component
of both [m]; measured zero-moment point [m]; the margin [m]; the velocity asked for and that of the last full step
[m/s, m/s, rad/s]; the measured joint angles [rad]. What is unknown is 0.

Action: numbers from -1 to 1. `"request"`: three, times 0.2 m/s ahead, 0.1 m/s to the left, 0.3 rad/s. `"joints"`: one
for each powered joint, times 0.2 rad.

Reward: for each second on its feet 1, less the distance of its velocity from the one asked for, over 0.5 m/s (a turn
counts 0.5 m per radian), less a hundredth of the action's mean square; a fall costs 5 once and ends the episode.
"""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from .errors import BadInput
from .messages import Joint, Mode
from .states import States
from .walk import Batch

__all__ = ["WalkEnv", "WalkVectorEnv"]

Floats = NDArray[np.float64]

_REQUEST = np.array([0.2, 0.1, 0.3])
_JOINTS = 0.2
_FIRST_POWERED = 2
"""The first two joints are those of the foot on the ground: they have no drive."""
_FALL_COSTS = 5.0
_STEPPING = (Mode.STARTING, Mode.WALKING, Mode.STOPPING, Mode.IN_PLACE)
_GRAVITY = 9.80665


def _unknown_is_zero(numbers: Floats) -> Floats:
    return np.nan_to_num(numbers, nan=0.0, posinf=0.0, neginf=0.0)


class _Task:
    """What single and vector environment share: many episodes beside each other."""

    def __init__(
        self,
        count: int,
        robot: str | None,
        residual: str,
        every: float,
        seconds: float,
        velocity: tuple[Floats, Floats],
        push: float,
        options: dict[str, Any],
    ) -> None:
        if residual not in ("request", "joints"):
            raise BadInput(f'residual = "{residual}": must be "request" or "joints"')
        self.count, self.residual, self.velocity, self.push = count, residual, velocity, push
        self.batch = Batch(robot, count, **options)
        rate = self.batch.rate_hz or 1000
        self.periods = max(1, round(every * rate))
        self.period = self.periods / rate
        self.steps_max = round(seconds / self.period)
        self.asked = np.zeros((count, 3))
        self.added = np.zeros((count, 3))
        self.steps = np.zeros(count, int)
        self.push_at = np.zeros(count, int)
        self.push_impulse = np.zeros((count, 3))
        actions = 3 if residual == "request" else len(Joint) - _FIRST_POWERED
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (actions,), np.float32)
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (36,), np.float32)

    def begin(self, which: NDArray[np.bool_], random: np.random.Generator) -> None:
        """Begins episodes: a walk at a random velocity, and one push at a random time."""
        chosen = np.flatnonzero(which)
        self.batch.reset(which, seeds=random.integers(0, 2**31, self.count))
        low, high = self.velocity
        self.asked[chosen] = random.uniform(low, high, (len(chosen), 3))
        self.added[chosen] = 0.0
        self.steps[chosen] = 0
        self.push_at[chosen] = random.integers(self.steps_max // 4, 3 * self.steps_max // 4 + 1, len(chosen))
        angle = random.uniform(0, 2 * np.pi, len(chosen))
        size = self.push * random.uniform(0.5, 1.0, len(chosen))
        self.push_impulse[chosen] = np.stack([size * np.cos(angle), size * np.sin(angle), 0 * size], axis=1)
        if self.residual == "joints":
            self.batch.residuals(np.zeros(len(Joint)))
        self._ask(which)

    def step(self, actions: ArrayLike) -> tuple[States, Floats, NDArray[np.bool_], NDArray[np.bool_]]:
        """Goes on by a step: states, rewards, who fell, and whose time is over."""
        action = np.clip(np.asarray(actions, float).reshape(self.count, -1), -1, 1)
        if self.residual == "request":
            added = action * _REQUEST
            # A request is evaluated for some milliseconds: what is the same is not asked for again.
            changed = np.abs(added - self.added).max(axis=1) > 0.01
            self.added[changed] = added[changed]
            if changed.any():
                self._ask(changed)
        else:
            angles = np.zeros((self.count, len(Joint)))
            angles[:, _FIRST_POWERED:] = action * _JOINTS
            self.batch.residuals(angles)
        pushed = self.steps == self.push_at
        if self.push > 0 and pushed.any():
            self.batch.push(np.where(pushed[:, None], self.push_impulse, 0.0))
        self.batch.step(self.periods)
        self.steps += 1
        states = self.batch.states
        unstable = np.array([why is not None for why in self.batch.ended])
        fell = states.fallen | unstable
        off = _unknown_is_zero(states.estimated_velocity) - self.asked
        distance = np.hypot(np.hypot(off[:, 0], off[:, 1]), 0.5 * off[:, 2])
        reward = self.period * (1.0 - distance / 0.5 - 0.01 * (action**2).mean(axis=1)) - _FALL_COSTS * fell
        return states, reward, fell, (self.steps >= self.steps_max) & ~fell

    def observation(self, states: States) -> NDArray[np.float32]:
        """What a policy sees, one row for each episode."""
        com, velocity = states.com_in_support, states.com_velocity_in_support
        with np.errstate(invalid="ignore", divide="ignore"):
            divergent = com[:, :2] + velocity[:, :2] * np.sqrt(com[:, 2:3] / _GRAVITY)
        columns = [
            2 * states.support[:, None] - 1,
            states.progress[:, None],
            np.isin(states.mode, _STEPPING)[:, None],
            com[:, :2],
            velocity[:, :2],
            divergent,
            states.zmp_in_support,
            states.margin[:, None],
            self.asked,
            states.estimated_velocity,
            states.measured_angles[:, _FIRST_POWERED:],
        ]
        return _unknown_is_zero(np.concatenate(columns, axis=1)).astype(np.float32)

    def _ask(self, which: NDArray[np.bool_]) -> None:
        vx, vy, wz = (self.asked + self.added).T
        stands = np.abs(self.asked + self.added).max(axis=1) == 0
        # A stand needs no request, and "no velocity" is one to stop.
        self.batch.ask(which=which & ~stands, vx=vx, vy=vy, wz_deg_s=np.degrees(wz))
        self.batch.ask(which=which & stands & (self.steps > 0), intent="stop")


def _velocity(velocity: Any) -> tuple[Floats, Floats]:
    low, high = np.asarray(velocity, float)
    return low, high


class WalkEnv(gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """One walk. See the module for observation, action and reward.

    robot: a robot in the box; other arguments of `Walk` go into `options`, such as `{"parameters": {…}}`.
    residual: `"request"` or `"joints"`.
    every: time of a step [s]. seconds: time of an episode [s].
    velocity: least and greatest velocity asked for: ahead, to the left [m/s], turning to the left [rad/s].
    push: greatest impulse of the push in an episode [N·s], from any side; half of it is the least.
    """

    metadata = {"render_modes": []}  # noqa: RUF012

    def __init__(
        self,
        robot: str | None = None,
        residual: str = "request",
        *,
        every: float = 0.02,
        seconds: float = 8.0,
        velocity: Any = ((0.0, 0.0, 0.0), (0.2, 0.0, 0.0)),
        push: float = 0.0,
        options: dict[str, Any] | None = None,
    ) -> None:
        """Makes the walk."""
        self._task = _Task(1, robot, residual, every, seconds, _velocity(velocity), push, options or {})
        self.action_space = self._task.action_space
        self.observation_space = self._task.observation_space

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begins an episode; `seed` decides all that is random in it and in those after it."""
        super().reset(seed=seed)
        self._task.begin(np.ones(1, bool), self.np_random)
        return self._task.observation(self._task.batch.states)[0], {}

    def step(self, action: NDArray[np.float32]) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Goes on by a step; `info["state"]` is the true state."""
        states, reward, fell, over = self._task.step(np.asarray(action)[None])
        return self._task.observation(states)[0], float(reward[0]), bool(fell[0]), bool(over[0]), {"state": states[0]}


class WalkVectorEnv(VectorEnv[NDArray[np.float32], NDArray[np.float32], NDArray[Any]]):
    """Many walks on all cores: as `WalkEnv`, with `num_envs`. An episode that is over begins anew with the next step."""

    metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}  # noqa: RUF012

    def __init__(
        self,
        num_envs: int,
        robot: str | None = None,
        residual: str = "request",
        *,
        every: float = 0.02,
        seconds: float = 8.0,
        velocity: Any = ((0.0, 0.0, 0.0), (0.2, 0.0, 0.0)),
        push: float = 0.0,
        options: dict[str, Any] | None = None,
    ) -> None:
        """Makes the walks."""
        self.num_envs = num_envs
        self._task = _Task(num_envs, robot, residual, every, seconds, _velocity(velocity), push, options or {})
        self.single_action_space = self._task.action_space
        self.single_observation_space = self._task.observation_space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._over = np.zeros(num_envs, bool)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Begins all episodes; `seed` decides all that is random in them and in those after."""
        super().reset(seed=seed, options=options)
        self._over[:] = False
        self._task.begin(np.ones(self.num_envs, bool), self.np_random)
        return self._task.observation(self._task.batch.states), {}

    def step(
        self, actions: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Goes on by a step; `info["states"]` are the true states."""
        anew = self._over.copy()
        if anew.any():
            self._task.begin(anew, self.np_random)
        states, reward, fell, over = self._task.step(actions)
        if anew.any():
            # What is asked in the step that begins an episode was meant for the one before.
            reward, fell, over = np.where(anew, 0.0, reward), fell & ~anew, over & ~anew
        self._over = fell | over
        return self._task.observation(states), reward, fell, over, {"states": states}
