//! Why a request was limited or refused.

use crate::code::codes;

codes! {
    /// Why a request was limited or refused.
    Reason {
        /// It was granted as requested.
        None = 0 "accepted as requested",
        /// The turn is outside the configured range.
        TurnLimit = 1 "the turn is outside the permitted range",
        /// The speed is outside the configured range.
        SpeedLimit = 2 "the speed is outside the permitted range",
        /// The step extension is outside the configured range.
        ExtensionLimit = 3 "the step extension is outside the permitted range",
        /// A requested value is NaN or infinite.
        NotFinite = 4 "a value is not a finite number",
        /// The uncompensated gait has stopped and has no plan to start again.
        CannotRestart = 5 "the uncompensated gait cannot restart from a stand: restart the controller",
        /// Too many requests are waiting for their tick.
        QueueFull = 6 "too many requests are waiting for their tick",
        /// A code in the request is unknown to this controller.
        UnknownCode = 7 "the request contains a code unknown to this controller",
        /// The request changes nothing.
        Empty = 8 "the request is empty",
        /// The controller is shutting down.
        ShuttingDown = 9 "the controller is shutting down",
        /// A source of higher priority is in control: see [`Reply::authority`](crate::Reply::authority).
        Outranked = 10 "a source of higher priority is in control",
        /// The predicted ZMP margin would be too small (m).
        Margin = 11 "the zero-moment point would come too close to the edge of the sole",
        /// A joint would leave its range (rad).
        JointRange = 12 "a joint would leave its range",
        /// A joint would exceed its rate limit (rad/s).
        JointRate = 13 "a joint would exceed its rate limit",
        /// A motor would exceed its torque limit (N·m).
        Torque = 14 "a motor would exceed its torque limit",
        /// A motor would need more than its supply voltage (V).
        Voltage = 15 "a motor would need more than its supply voltage",
        /// The swing sole would come too close to the ground or to the support foot (m).
        SoleClearance = 16 "the swing foot would come too close to the ground or to the other foot",
        /// A leg would be overextended.
        LegReach = 17 "a leg would be overextended",
        /// A stop or a newer request took its place before it could take effect.
        Superseded = 18 "a stop or a newer request replaced it",
        /// The robot has fallen.
        Fallen = 19 "the robot has fallen: set it upright and send reset",
        /// A fault is latched.
        Faulted = 20 "a fault is latched: send reset",
        /// The cause of the latched fault is still present.
        FaultPersists = 21 "the fault persists: the robot must be upright and its sensors agree; then reset again",
        /// The sole would slip: horizontal per vertical force of the ground.
        Friction = 22 "the support sole would slip",
        /// The sole would spin (N·m).
        YawTorque = 23 "the support sole would turn on the ground",
        /// No fault is latched.
        NothingToReset = 24 "no fault is latched: there is nothing to reset",
        /// Steps in place are not extended and at most at nominal speed.
        InPlace = 25 "in place the robot steps without extension and at most at speed 1: it takes effect once it walks",
        /// It expired before it could take effect: see [`Request::expires_ns`](crate::Request::expires_ns).
        Expired = 26 "it expired before it could take effect",
        /// The robot cannot move to a stand from its posture: its feet would slip.
        NotInStand = 27 "the robot is not in a stand: put its feet side by side first",
        /// The sidestep is outside the configured range.
        SidestepLimit = 28 "the sidestep is outside the permitted range",
        /// It asks for a velocity or a destination together with gait parameters, with another intent than to walk, or
        /// with each other.
        Contradictory = 29 "ask for one: gait parameters, a velocity or a destination; with a velocity or a \
                            destination goes no intent but walk",
        /// A destination has more than [`PLACES_MAX`](crate::PLACES_MAX) places.
        TooManyPlaces = 30 "more way-points or footsteps than can be given at a time",
        /// Two footsteps in turn are of the same foot.
        SameFoot = 31 "the same foot cannot step twice: right and left take turns",
        /// A footstep is out of the range of steps (m).
        StepTooFar = 32 "the foot would land too far from the other one",
        /// A foot would land on the wrong side of the other one (m).
        FeetCross = 33 "the feet would cross",
        /// A footstep would turn the foot too far against the other one (rad).
        StepTurn = 34 "the foot would be turned too far against the other one",
        /// The gait without compensation plans no footsteps.
        NoDestination = 35 "the uncompensated gait walks to no destination",
        /// A place is farther away than anyone walks (m).
        TooFar = 36 "it is farther away than is permitted",
    }
}
