"""The compiled part of the package. Use `halfstep.Walk` and `halfstep.Batch`."""

import os
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Path = str | os.PathLike[str]

def columns() -> list[tuple[str, int]]: ...
def robots() -> list[str]: ...

class Snapshot:
    """A walk as it was at an instant, to the bit."""

class Walk:
    def __new__(
        cls,
        robot: str | None = None,
        *,
        config: Path | None = None,
        urdf: Path | None = None,
        map: Path | None = None,
        seed: int = 0,
        from_stand: bool = True,
        rate_hz: int = 1000,
        parameters: dict[str, Any] | None = None,
        commands: Path | None = None,
        disturbances: Path | None = None,
    ) -> Walk: ...
    def step(self, periods: int = 1) -> None:
        """Walks on by so many control periods. Raises `Unstable` if the simulation becomes so."""
    def rows(self, rows: int, every: int) -> NDArray[np.float64]: ...
    def row(self) -> NDArray[np.float64]: ...
    def ask(self, line: str) -> str: ...
    def push(self, impulse: tuple[float, float, float], lasts: float = 0.1, name: str = "trunk") -> None: ...
    def residual(self, angles: Sequence[float]) -> None: ...
    def reset(self, seed: int | None = None) -> None:
        """Begins anew, with another seed if one is given."""
    def save(self) -> Snapshot:
        """The walk as it is now."""
    def restore(self, snapshot: Snapshot) -> None:
        """Goes back to how the walk was: from there it goes on to the same bits."""
    @property
    def tick(self) -> int:
        """Control periods walked."""
    @property
    def rate_hz(self) -> int:
        """Control periods per second."""
    @property
    def seed(self) -> int:
        """The seed of noise and mass errors."""
    @property
    def setpoint_hash(self) -> str:
        """One number for all setpoints so far, as `halfstep walk --lockstep` prints it: the same one is the same bits."""

class Batch:
    def __new__(
        cls,
        robot: str | None,
        seeds: Sequence[int],
        *,
        config: Path | None = None,
        urdf: Path | None = None,
        map: Path | None = None,
        from_stand: bool = True,
        rate_hz: int = 1000,
        parameters: list[dict[str, Any]] | None = None,
        commands: Path | None = None,
        disturbances: list[Path | None] | None = None,
        threads: int | None = None,
    ) -> Batch: ...
    def __len__(self) -> int: ...
    def step(self, periods: int = 1) -> None:
        """All walk on by so many control periods. One whose simulation becomes unstable ends."""
    def rows(self) -> NDArray[np.float64]: ...
    def ask(self, lines: Sequence[str | None]) -> None: ...
    def replies(self) -> list[str | None]: ...
    def push(self, impulses: NDArray[np.float64], lasts: float = 0.1, name: str = "trunk") -> None: ...
    def residuals(self, angles: NDArray[np.float64]) -> None: ...
    def reset_one(self, place: int, seed: int | None = None) -> None: ...
    def save(self, place: int) -> Snapshot:
        """One of the walks as it is now."""
    def restore(self, place: int, snapshot: Snapshot) -> None:
        """One of the walks goes on from there."""
    @property
    def ended(self) -> list[str | None]:
        """Why walks are at their end, where they are."""
    @property
    def seeds(self) -> list[int]:
        """The seeds."""
    @property
    def rate_hz(self) -> int | None:
        """Control periods per second."""
    @property
    def setpoint_hashes(self) -> list[str]:
        """For each walk, one number for all its setpoints so far."""
