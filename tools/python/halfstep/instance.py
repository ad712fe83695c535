"""An instance: one robot's name and the memory that its processes share. The counterpart of `crates/wire`."""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import re
import stat
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import iceoryx2 as iox2

from .errors import BadName, HalfstepError, Mismatch, NoController
from .messages import PROTOCOL

# Longer than it takes several others to connect.
_TURN_PATIENCE_S = 20.0
# How long a process that is just leaving may stand in the way.
_PATIENCE_S = 1.0
_PAUSE_S = 0.005
_SHARED_MEMORY = Path("/dev/shm")
# As in `crates/wire/src/shared_memory.rs` (bytes).
_NEEDED = {"operator": 1 << 20, "observer": 64 << 10, "plant": 512 << 10}


class Instance:
    """One robot: its name and where its memory lies. Nothing is created yet."""

    def __init__(self, name: str = "default") -> None:
        """`name` has 1 to 32 of a-z, 0-9, _ and -; otherwise `BadName`."""
        if not re.fullmatch(r"[a-z0-9_-]{1,32}", name):
            raise BadName(f"instance name {name!r} is not usable; write 1 to 32 of a-z, 0-9, _ and -, e.g. 'robot-1'")
        self.name = name
        self.root = _runtime_folder() / name
        self.config = iox2.config.default()
        self.config.global_cfg.prefix = iox2.FileName.new(f"halfstep.{_fnv_1a(os.fsencode(self.root)):016x}.{name}.")
        self.config.global_cfg.root_path = iox2.Path.new(str(self.root))

    @contextlib.contextmanager
    def turn(self, create: bool = False) -> Iterator[None]:
        """Processes of an instance connect one after the other: waits for the turn, and gives it back.

        Without `create` the instance must be there: `NoController`.
        """
        if not create and not self.root.exists():
            raise NoController(f"no controller is running on instance {self.name!r}")
        began = time.monotonic()
        while True:
            lock = self._lock()
            if lock is not None:
                try:
                    yield
                finally:
                    os.close(lock)
                return
            if time.monotonic() - began > _TURN_PATIENCE_S:
                raise HalfstepError(f"another process does not finish connecting to instance {self.name!r}")
            time.sleep(_PAUSE_S)

    def _lock(self) -> int | None:
        """The locked file, or None if another process holds the lock."""
        _create(self.root.parent)
        lock = None
        try:
            _create(self.root)
            # Not truncated, and never through a link.
            lock = os.open(self.root / "turn", os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            # Whoever had the turn may have removed the whole folder.
            if os.stat(self.root / "turn").st_ino == os.fstat(lock).st_ino:
                taken, lock = lock, None
                return taken
        except (FileNotFoundError, BlockingIOError):
            pass
        finally:
            if lock is not None:
                os.close(lock)
        return None

    def join(self, role: str) -> Any:
        """A node of the instance; only whose turn it is may ask for it."""
        _require_room(role)
        iox2.set_log_level_from_env_or(iox2.LogLevel.Fatal)
        return (
            iox2.NodeBuilder.new()
            .name(iox2.NodeName.new(role))
            .config(self.config)
            .signal_handling_mode(iox2.SignalHandlingMode.Disabled)
            .create(iox2.ServiceType.Ipc)
        )

    def take_room(self, role: str) -> None:
        """Takes the memory of what was connected to at once: who writes where none is left dies of SIGBUS."""
        for file in _SHARED_MEMORY.glob(f"{self.config.global_cfg.prefix}*"):
            with contextlib.suppress(PermissionError, FileNotFoundError):
                opened = os.open(file, os.O_RDWR | os.O_CLOEXEC)
                try:
                    os.posix_fallocate(opened, 0, max(os.fstat(opened).st_size, 1))
                except OSError as cause:
                    if cause.errno == errno.ENOSPC:
                        raise _no_room(role) from cause
                finally:
                    os.close(opened)

    def service_name(self, service: str) -> Any:
        """What shared memory calls a service."""
        return iox2.ServiceName.new(f"halfstep/{self.name}/{service}")


def _require_room(role: str) -> None:
    found = os.statvfs(_SHARED_MEMORY)
    if found.f_blocks and found.f_bavail * found.f_frsize < _NEEDED[role]:
        raise _no_room(role)


def _no_room(role: str) -> HalfstepError:
    found = os.statvfs(_SHARED_MEMORY)
    free = found.f_bavail * found.f_frsize / 2**20
    return HalfstepError(
        f"shared memory ({_SHARED_MEMORY}) has no room for this {role}: it needs {_NEEDED[role] / 2**20:.1f} MB, and "
        f"{free:.1f} MB are free; remove other files there, or give it more (in a container: docker run --shm-size=256m)"
    )


def _runtime_folder() -> Path:
    """The folder of this user's instances; see `crates/wire/src/runtime_folder.rs`."""
    given = os.environ.get("XDG_RUNTIME_DIR", "")
    candidates = [given] if os.path.isabs(given) else []
    for candidate in [*candidates, f"/run/user/{os.getuid()}"]:
        with contextlib.suppress(OSError):
            _check_own(Path(candidate))
            return Path(candidate) / f"halfstep-{os.getuid()}"
    return Path("/tmp") / f"halfstep-{os.getuid()}"


def _create(folder: Path) -> None:
    """Creates a folder that only this user may enter, or makes sure that it is one."""
    with contextlib.suppress(FileExistsError):
        folder.mkdir(mode=0o700)
    _check_own(folder)


def _check_own(folder: Path) -> None:
    found = os.lstat(folder)
    is_own = stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o077
    if not is_own:
        raise PermissionError(
            f"{folder} is not safe to use: it must be a folder that belongs to this user and that nobody else may "
            "enter; remove it, or set XDG_RUNTIME_DIR to a folder of your own"
        )


def _fnv_1a(data: bytes) -> int:
    """The FNV-1a hash, 64 bits."""
    value = 0xCBF29CE484222325
    for byte in data:
        value = ((value ^ byte) * 0x100000001B3) & 0xFFFFFFFFFFFFFFFF
    return value


class Agreement:
    """A service of an instance, and what both sides must agree on."""

    def __init__(
        self,
        instance: Instance,
        service: str,
        pattern: Any,
        mechanism: int | None = None,
        rate_hz: int = 1000,
        clock: str = "realtime",
        start: str = "stride",
    ) -> None:
        self.instance = instance
        self.name = instance.service_name(service)
        self.service = f"halfstep/{instance.name}/{service}"
        self.pattern = pattern
        self.terms = {"protocol": str(PROTOCOL)}
        if mechanism is not None:
            self.terms["mechanism"] = f"{mechanism:#018x}"
            self.terms["rate_hz"] = str(rate_hz)
            self.terms["clock"] = clock
        # Compared only before the robot moves.
        self.initial = {} if mechanism is None else {"start": start}

    def specifier(self) -> Any:
        """The terms, for whoever creates the service."""
        specifier = iox2.AttributeSpecifier.new()
        for key, value in (self.terms | self.initial).items():
            specifier = specifier.define(iox2.AttributeKey.new(key), iox2.AttributeValue.new(value))
        return specifier

    def open(self, open_service: Callable[[], Any]) -> Any:
        """Opens the service, which a controller must have made."""
        service = self._patiently(open_service, None)
        self._check(service.attributes, self.terms)
        return service

    def check_start(self, service: Any) -> None:
        """Compares what both sides must begin with: for a robot that has not moved yet."""
        self._check(service.attributes, self.initial)

    def open_or_create(self, open_service: Callable[[], Any], create: Callable[[], Any]) -> Any:
        """Opens the service if it is there and creates it if it is not: either side may start first."""
        service = self._patiently(open_service, create)
        self._check(service.attributes, self.terms)
        return service

    def _patiently(self, open_service: Callable[[], Any], create: Callable[[], Any] | None) -> Any:
        began = time.monotonic()
        while True:
            try:
                return open_service()
            except Exception as cause:  # iceoryx2 has one error type per operation, without a common base
                failed = cause
            details = self._details()
            if details is not None:
                self._check(details.static_details.attributes, self.terms)
            elif create is None:
                raise NoController(f"no controller is running on instance {self.instance.name!r}") from failed
            else:
                try:
                    return create()
                except Exception as cause:  # as above
                    failed = cause
            if time.monotonic() - began > _PATIENCE_S:
                raise HalfstepError(f"cannot open {self.service}: {failed!r}") from failed
            time.sleep(_PAUSE_S)

    def _details(self) -> Any:
        try:
            return iox2.Service.details(self.name, self.instance.config, self.pattern, iox2.ServiceType.Ipc)
        except Exception:  # it is going or coming: the next look tells
            return None

    def _check(self, attributes: Any, terms: dict[str, str]) -> None:
        theirs = {a.key.to_string(): a.value.to_string() for a in attributes.values}
        for key, ours in terms.items():
            if theirs.get(key) != ours:
                raise Mismatch(f"{self.service}: this package has the {key} {ours}, the other side {theirs.get(key)}")
