"""What can go wrong on the way."""


class HalfstepError(Exception):
    """All of them."""


class BadName(HalfstepError):
    """The instance's name cannot be part of a file name everywhere."""


class NoController(HalfstepError):
    """Nobody is there to answer or to report."""


class Mismatch(HalfstepError):
    """The other side speaks another version, or means another robot."""


class AlreadyRunning(HalfstepError):
    """There is one controller and one plant per instance, and one is there."""


class TimedOut(HalfstepError):
    """It took too long."""


class BadInput(HalfstepError, ValueError):
    """A wrong value of an argument or in a configuration: file, key, value and remedy."""


class Unstable(HalfstepError):
    """The simulation has become unstable: its numbers mean nothing any more."""
