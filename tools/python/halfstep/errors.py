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
