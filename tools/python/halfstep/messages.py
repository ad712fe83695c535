"""The messages as they lie in shared memory.

Written by `halfstep export python`; a test of the repository compares. Do not edit. The meaning of the fields is in
`crates/wire/src/message/`; angles are in radians, joints in the order of the paper.
"""

from ctypes import Array, c_double, c_uint32, c_uint64
from enum import IntEnum, IntFlag

from .message import Message

PROTOCOL = 8
"""The version of all layouts and meanings."""


class Intent(IntEnum):
    WALK = 1  # walk
    STOP = 2  # stop
    HOLD = 3  # hold
    RESET = 4  # reset
    IN_PLACE = 5  # in-place


class Source(IntEnum):
    CONSOLE = 0  # console
    SCRIPT = 1  # script
    TELEOP = 2  # teleop
    PROGRAM = 3  # program
    CONTROL_LOOP = 4  # control loop


class Lifetime(IntEnum):
    LATCHED = 0  # until replaced
    STREAMED = 1  # while its source keeps sending
    RELEASE = 2  # released by its source


class Verdict(IntEnum):
    ACCEPTED = 1  # accepted
    LIMITED = 2  # limited
    REFUSED = 3  # refused


class Reason(IntEnum):
    NONE = 0  # accepted as requested
    TURN_LIMIT = 1  # the turn is outside the permitted range
    SPEED_LIMIT = 2  # the speed is outside the permitted range
    EXTENSION_LIMIT = 3  # the step extension is outside the permitted range
    NOT_FINITE = 4  # a value is not a finite number
    CANNOT_RESTART = 5  # the uncompensated gait cannot restart from a stand: restart the controller
    QUEUE_FULL = 6  # too many requests are waiting for their tick
    UNKNOWN_CODE = 7  # the request contains a code unknown to this controller
    EMPTY = 8  # the request is empty
    SHUTTING_DOWN = 9  # the controller is shutting down
    OUTRANKED = 10  # a source of higher priority is in control
    MARGIN = 11  # the zero-moment point would come too close to the edge of the sole
    JOINT_RANGE = 12  # a joint would leave its range
    JOINT_RATE = 13  # a joint would exceed its rate limit
    TORQUE = 14  # a motor would exceed its torque limit
    VOLTAGE = 15  # a motor would need more than its supply voltage
    SOLE_CLEARANCE = 16  # the swing foot would come too close to the ground or to the other foot
    LEG_REACH = 17  # a leg would be overextended
    SUPERSEDED = 18  # a stop or a newer request replaced it
    FALLEN = 19  # the robot has fallen: set it upright and send reset
    FAULTED = 20  # a fault is latched: send reset
    FAULT_PERSISTS = 21  # the fault persists: the robot must be upright and its sensors agree; then reset again
    FRICTION = 22  # the support sole would slip
    YAW_TORQUE = 23  # the support sole would turn on the ground
    NOTHING_TO_RESET = 24  # no fault is latched: there is nothing to reset
    IN_PLACE = 25  # in place the robot steps without extension and at most at speed 1: it takes effect once it walks
    EXPIRED = 26  # it expired before it could take effect
    NOT_IN_STAND = 27  # the robot is not in a stand: put its feet side by side first
    SIDESTEP_LIMIT = 28  # the sidestep is outside the permitted range
    CONTRADICTORY = 29  # ask for one: gait parameters, a velocity or a destination; with a velocity or a destination goes no intent but walk
    TOO_MANY_PLACES = 30  # more way-points or footsteps than can be given at a time
    SAME_FOOT = 31  # the same foot cannot step twice: right and left take turns
    STEP_TOO_FAR = 32  # the foot would land too far from the other one
    FEET_CROSS = 33  # the feet would cross
    STEP_TURN = 34  # the foot would be turned too far against the other one
    NO_DESTINATION = 35  # the uncompensated gait walks to no destination
    TOO_FAR = 36  # it is farther away than is permitted


class Mode(IntEnum):
    WALKING = 0  # walking
    HOLDING = 1  # holding
    FALLEN = 2  # fallen
    STARTING = 3  # starting
    STANDING = 4  # standing
    STOPPING = 5  # stopping
    FAULTED = 6  # faulted
    IN_PLACE = 7  # in place


class Capturability(IntEnum):
    BY_ANKLES = 1  # balanced
    BY_STEPS = 2  # catching itself
    LOST = 3  # falling


class Fault(IntFlag):
    MEASUREMENT_NOT_FINITE = 1  # a measurement contains a value that is not finite
    MEASUREMENT_IMPLAUSIBLE = 2  # a measurement contains an implausible value
    MEASUREMENT_STALE = 4  # no valid measurement has arrived for too long
    MEASUREMENT_OUT_OF_ORDER = 8  # a measurement is older than the one before
    ANGLE_LIMITED = 16  # a joint angle was limited to its range
    RATE_LIMITED = 32  # a joint rate was limited
    SETPOINT_NOT_FINITE = 64  # the setpoint was not finite; the last valid one was sent
    IN_THE_AIR = 128  # the feet bear too little force for a zero-moment point
    FALLEN = 256  # the robot has fallen
    OUT_OF_REACH = 1024  # the plan needed a foot out of a leg's reach
    MEASUREMENT_FROZEN = 2048  # a sensor's value has stopped changing
    MEASUREMENT_MISSING = 131072  # a sensor has no value
    MEASUREMENT_INCONSISTENT = 4096  # sensors contradict each other
    JOINT_OFF_SETPOINT = 8192  # a joint is not where it was commanded to be
    UNEXPECTED_POSTURE = 16384  # the robot is not in the posture in which the controller begins
    ORIENTATION_ASKEW = 65536  # the measured orientation and the forces on the feet disagree about the vertical
    NOT_RECORDED = 32768  # the run can no longer be recorded
    DEADLINE_MISSED = 512  # a deadline was missed


class PushOutcome(IntEnum):
    BEGUN = 0  # pushed
    INVALID = 1  # a push needs a link with a body, a finite impulse and a duration
    OUT_OF_RANGE = 2  # a push must last 1 ms to 10 s and have at most 10000 N·s
    TOO_MANY = 3  # too many pushes act at the same time
    NO_SUCH_LINK = 4  # the engine that computes the physics has no such link


class SensorGroup(IntFlag):
    JOINTS = 1  # angles and rates of the joints
    ORIENTATION = 2  # orientation of the trunk
    ANGULAR_RATE = 4  # angular rate of the trunk
    SPECIFIC_FORCE = 8  # accelerometer of the trunk
    RIGHT_FOOT = 16  # force sensor of the right foot
    LEFT_FOOT = 32  # force sensor of the left foot


class Joint(IntEnum):
    """Place of a joint in an array of joints."""

    FOOT_ROLL = 0  # joint 1
    FOOT_PITCH = 1  # joint 2
    RIGHT_ANKLE_ROLL = 2  # joint 3
    RIGHT_ANKLE_PITCH = 3  # joint 4
    RIGHT_KNEE = 4  # joint 5
    RIGHT_HIP_PITCH = 5  # joint 6
    RIGHT_HIP_YAW = 6  # joint 7
    RIGHT_HIP_ROLL = 7  # joint 8
    LEFT_HIP_ROLL = 8  # joint 9
    LEFT_HIP_YAW = 9  # joint 10
    LEFT_HIP_PITCH = 10  # joint 11
    LEFT_KNEE = 11  # joint 12
    LEFT_ANKLE_PITCH = 12  # joint 13
    LEFT_ANKLE_ROLL = 13  # joint 14
    WAIST_PITCH = 14  # joint 15
    WAIST_ROLL = 15  # joint 16
    RIGHT_SHOULDER = 16  # joint 17
    RIGHT_ELBOW = 17  # joint 18
    LEFT_SHOULDER = 18  # joint 19
    LEFT_ELBOW = 19  # joint 20


class Setpoint(Message):
    """`halfstep.Setpoint.v1`, 496 bytes."""

    tick: int
    time_ns: int
    angles: Array[c_double]
    rates: Array[c_double]
    feed_forward: Array[c_double]

    _fields_ = [
        ("tick", c_uint64),
        ("time_ns", c_uint64),
        ("angles", c_double * 20),
        ("rates", c_double * 20),
        ("feed_forward", c_double * 20),
    ]

    @staticmethod
    def type_name() -> str:
        """What shared memory calls it."""
        return "halfstep.Setpoint.v1"


class Measurement(Message):
    """`halfstep.Measurement.v3`, 688 bytes."""

    tick: int
    time_ns: int
    sample: int
    angles: Array[c_double]
    rates: Array[c_double]
    wrench_right: Array[c_double]
    wrench_left: Array[c_double]
    imu_orientation: Array[c_double]
    imu_rate: Array[c_double]
    motor_current: Array[c_double]
    imu_specific_force: Array[c_double]
    missing: int

    _fields_ = [
        ("tick", c_uint64),
        ("time_ns", c_uint64),
        ("sample", c_uint64),
        ("angles", c_double * 20),
        ("rates", c_double * 20),
        ("wrench_right", c_double * 6),
        ("wrench_left", c_double * 6),
        ("imu_orientation", c_double * 4),
        ("imu_rate", c_double * 3),
        ("motor_current", c_double * 20),
        ("imu_specific_force", c_double * 3),
        ("missing", c_uint64),
    ]

    @staticmethod
    def type_name() -> str:
        """What shared memory calls it."""
        return "halfstep.Measurement.v3"


class Request(Message):
    """`halfstep.Request.v5`, 696 bytes."""

    not_before: int
    present: int
    intent: int
    source: int
    lasting: int
    turn: float
    speed: float
    extension: float
    sidestep: float
    velocity: Array[c_double]
    places: Array[c_double]
    place_count: int
    place_kind: int
    place_frame: int
    place_marks: int
    age_limit: float
    id: int
    expires_ns: int

    _fields_ = [
        ("not_before", c_uint64),
        ("present", c_uint32),
        ("intent", c_uint32),
        ("source", c_uint32),
        ("lasting", c_uint32),
        ("turn", c_double),
        ("speed", c_double),
        ("extension", c_double),
        ("sidestep", c_double),
        ("velocity", c_double * 3),
        ("places", c_double * 72),
        ("place_count", c_uint32),
        ("place_kind", c_uint32),
        ("place_frame", c_uint32),
        ("place_marks", c_uint32),
        ("age_limit", c_double),
        ("id", c_uint64),
        ("expires_ns", c_uint64),
    ]

    @staticmethod
    def type_name() -> str:
        """What shared memory calls it."""
        return "halfstep.Request.v5"


class Reply(Message):
    """`halfstep.Reply.v5`, 184 bytes."""

    id: int
    verdict: int
    reason: int
    effect_half_step: int
    turn: float
    speed: float
    extension: float
    sidestep: float
    step_ahead: float
    step_aside: float
    velocity: Array[c_double]
    intent: int
    known: int
    joint: int
    source: int
    value: float
    limit: float
    remaining: float
    predicted_margin: float
    mode: int
    fault: int
    fault_time: float
    cause: int
    sensor: int
    place: int
    arrival: float

    _fields_ = [
        ("id", c_uint64),
        ("verdict", c_uint32),
        ("reason", c_uint32),
        ("effect_half_step", c_uint64),
        ("turn", c_double),
        ("speed", c_double),
        ("extension", c_double),
        ("sidestep", c_double),
        ("step_ahead", c_double),
        ("step_aside", c_double),
        ("velocity", c_double * 3),
        ("intent", c_uint32),
        ("known", c_uint32),
        ("joint", c_uint32),
        ("source", c_uint32),
        ("value", c_double),
        ("limit", c_double),
        ("remaining", c_double),
        ("predicted_margin", c_double),
        ("mode", c_uint32),
        ("fault", c_uint32),
        ("fault_time", c_double),
        ("cause", c_uint32),
        ("sensor", c_uint32),
        ("place", c_uint64),
        ("arrival", c_double),
    ]

    @staticmethod
    def type_name() -> str:
        """What shared memory calls it."""
        return "halfstep.Reply.v5"


class Report(Message):
    """`halfstep.Report.v5`, 480 bytes."""

    tick: int
    time_ns: int
    mode: int
    support: int
    half_step: int
    progress: float
    speed: float
    turn: float
    extension: float
    sidestep: float
    zmp_in_support: Array[c_double]
    zmp_planned: Array[c_double]
    margin: float
    lean: Array[c_double]
    added: Array[c_double]
    com_in_support: Array[c_double]
    com_velocity_in_support: Array[c_double]
    com_planned: Array[c_double]
    com_velocity_planned: Array[c_double]
    pose: Array[c_double]
    walk_velocity: Array[c_double]
    support_sole: Array[c_double]
    landing: Array[c_double]
    landing_after: Array[c_double]
    destination: int
    destination_places_left: int
    destination_distance: float
    destination_turn: float
    capturability: int
    contact: int
    external_force: Array[c_double]
    com_offset: Array[c_double]
    gyro_bias: Array[c_double]
    faults: int
    missed: int
    compute_ns: int

    _fields_ = [
        ("tick", c_uint64),
        ("time_ns", c_uint64),
        ("mode", c_uint32),
        ("support", c_uint32),
        ("half_step", c_uint64),
        ("progress", c_double),
        ("speed", c_double),
        ("turn", c_double),
        ("extension", c_double),
        ("sidestep", c_double),
        ("zmp_in_support", c_double * 2),
        ("zmp_planned", c_double * 2),
        ("margin", c_double),
        ("lean", c_double * 2),
        ("added", c_double * 4),
        ("com_in_support", c_double * 3),
        ("com_velocity_in_support", c_double * 3),
        ("com_planned", c_double * 3),
        ("com_velocity_planned", c_double * 3),
        ("pose", c_double * 3),
        ("walk_velocity", c_double * 3),
        ("support_sole", c_double * 3),
        ("landing", c_double * 3),
        ("landing_after", c_double * 3),
        ("destination", c_uint32),
        ("destination_places_left", c_uint32),
        ("destination_distance", c_double),
        ("destination_turn", c_double),
        ("capturability", c_uint32),
        ("contact", c_uint32),
        ("external_force", c_double * 2),
        ("com_offset", c_double * 2),
        ("gyro_bias", c_double * 3),
        ("faults", c_uint32),
        ("missed", c_uint32),
        ("compute_ns", c_uint64),
    ]

    @staticmethod
    def type_name() -> str:
        """What shared memory calls it."""
        return "halfstep.Report.v5"


class PushRequest(Message):
    """`halfstep.PushRequest.v1`, 40 bytes."""

    link: int
    impulse: Array[c_double]
    duration: float

    _fields_ = [
        ("link", c_uint64),
        ("impulse", c_double * 3),
        ("duration", c_double),
    ]

    @staticmethod
    def type_name() -> str:
        """What shared memory calls it."""
        return "halfstep.PushRequest.v1"


class PushReply(Message):
    """`halfstep.PushReply.v1`, 16 bytes."""

    outcome: int
    start: float

    _fields_ = [
        ("outcome", c_uint64),
        ("start", c_double),
    ]

    @staticmethod
    def type_name() -> str:
        """What shared memory calls it."""
        return "halfstep.PushReply.v1"


class TruePose(Message):
    """`halfstep.TruePose.v1`, 72 bytes."""

    tick: int
    time_ns: int
    position: Array[c_double]
    orientation: Array[c_double]

    _fields_ = [
        ("tick", c_uint64),
        ("time_ns", c_uint64),
        ("position", c_double * 3),
        ("orientation", c_double * 4),
    ]

    @staticmethod
    def type_name() -> str:
        """What shared memory calls it."""
        return "halfstep.TruePose.v1"
