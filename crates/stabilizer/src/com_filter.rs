//! A Kalman filter of the centre of mass against its plan: how fast it moves beyond the plan, by how much its measured
//! place is off for good, and which external force acts.
//!
//! Over the ground the robot moves as a pendulum: `c̈ = ω²·(c − p) + f/m` (Kajita et al. 2001). What its legs and arms
//! do beside that is planned, so the filter compares with the plan: `v̇ = ω²·(y − d − q) + a`, where `v` is the
//! velocity of the centre of mass beyond the plan, `y` its measured place beyond the plan, `q` the zero-moment point
//! beyond the plan, and `a` the acceleration by an external force. The offset `d` of the measured place shows in
//! nothing but the motion: a payload, an inertial measurement unit that is mounted askew, a mass other than believed.
//! `d` changes slowly, `a` fades fast; else they look alike.
//!
//! Place and velocity as such are measured with so little noise that feedback takes them as they are, without the lag
//! of a filter; between samples they move on by the same law. Both axes have the same noise, so they share the
//! covariance.

use model::{ComState, Mechanism};
use nalgebra::{Matrix3, Matrix3x2, Vector2, Vector3};

use crate::acceleration_evidence::AccelerationEvidence;
use crate::proportions::StabilizerProportions;

/// Standard deviation of the measured velocity of the centre of mass (m/s): of a gyro with noise of 0.3°/s.
const VELOCITY_NOISE: f64 = 5e-3;
/// That of the trunk's acceleration as one of the centre of mass (m/s²): the trunk shakes.
const ACCELERATION_NOISE: f64 = 2.0;
/// White noise of the acceleration (m/s² · √s): the robot is not quite the plan's.
const ACCELERATION_WALK: f64 = 0.02;
/// Random walk of the external acceleration (m/s² / √s), and the time constant with which it fades (s): it is a quarter
/// of a m/s² most of the time, and a push is seen within 20 ms.
const EXTERNAL_WALK: f64 = 1.1;
const EXTERNAL_TIME_CONSTANT: f64 = 0.1;
/// External acceleration of a push, while which no offset is learnt (m/s²).
const EXTERNAL_OF_PUSH: f64 = 0.5;
/// Random walk of the offset (m / √s): with the noise above it is learnt in about 5 s.
const OFFSET_WALK: f64 = 2e-3;
/// What is not known at the beginning: velocity (m/s), offset (m), external acceleration (m/s²).
const UNKNOWN: Vector3<f64> = Vector3::new(0.5, 5e-3, 0.25);
/// Longest time without a usable measurement that is bridged (s).
const BRIDGED_MAX: f64 = 0.05;
/// Least age of the state to which the filter returns when a sensor is found to be wrong (s): the samples before that
/// were already wrong.
const TRUSTED_AGE: f64 = 0.005;

/// Time after a support change before an offset is learnt (s): late samples are still of the other foot.
const SETTLED: f64 = 0.12;

/// Rows of the state.
const VELOCITY: usize = 0;
const OFFSET: usize = 1;
const EXTERNAL: usize = 2;

/// The filter. Everything is in support coordinates.
#[derive(Clone, Debug)]
pub struct ComFilter {
    state: Deviation,
    covariance: Matrix3<f64>,
    /// The last known deviation of the zero-moment point (m).
    zmp: Option<Vector2<f64>>,
    /// `ω²` of the planned pendulum (1/s²).
    stiffness: f64,
    /// The state to return to, and the one that will become it, with their ages (s).
    trusted: Option<(Deviation, f64)>,
    candidate: Option<(Deviation, f64)>,
    /// Time since the last usable measurement (s); infinite before the first.
    unmeasured_for: f64,
    /// Time since place and velocity were measured anew (s).
    since_restart: f64,
    /// Whether the last sample let the offset be learnt.
    learns_offset: bool,
    proportions: StabilizerProportions,
}

/// How the robot deviates from the plan.
#[derive(Clone, Copy, Debug, Default)]
struct Deviation {
    /// Of the measured centre of mass (m).
    position: Vector2<f64>,
    /// Of its measured velocity (m/s).
    velocity: Vector2<f64>,
    /// Velocity, offset and external acceleration, a column for each axis.
    filtered: Matrix3x2<f64>,
}

impl ComFilter {
    /// A filter that knows nothing of a robot.
    pub fn new(mechanism: &Mechanism) -> Self {
        Self {
            state: Deviation::default(),
            covariance: Matrix3::from_diagonal(&UNKNOWN.component_mul(&UNKNOWN)),
            zmp: None,
            stiffness: 0.0,
            trusted: None,
            candidate: None,
            unmeasured_for: f64::INFINITY,
            since_restart: 0.0,
            learns_offset: false,
            proportions: StabilizerProportions::of(mechanism),
        }
    }

    /// Lets `dt` seconds pass. The zero-moment point stays off its plan by as much as it last was.
    pub fn advance(&mut self, dt: f64) {
        self.unmeasured_for += dt;
        self.since_restart += dt;
        for (_, age) in [&mut self.trusted, &mut self.candidate].into_iter().flatten() {
            *age += dt;
        }
        self.state = self.moved(&self.state, dt);
        let transition = self.transition(dt);
        let offset_walk = if self.learns_offset { OFFSET_WALK } else { 0.0 };
        let walks = Vector3::new(ACCELERATION_WALK, offset_walk, EXTERNAL_WALK);
        let grown = Matrix3::from_diagonal(&(walks.component_mul(&walks) * dt));
        self.covariance = transition * self.covariance * transition.transpose() + grown;
    }

    /// Absorbs a measurement.
    ///
    /// * `planned` – the centre of mass at the same time, as planned
    pub fn absorb(&mut self, measured: &ComState, planned: &ComState, evidence: &AccelerationEvidence) {
        self.stiffness = planned.pendulum_rate().powi(2);
        self.zmp = evidence.zmp;
        self.unmeasured_for = 0.0;
        self.state.position = (measured.position - planned.position).xy();
        let velocity = (measured.velocity - planned.velocity).xy();
        self.state.velocity = velocity;
        // A robot that tips or is pushed moves otherwise than the pendulum.
        let error = self.state.position - self.com_offset() + velocity / planned.pendulum_rate();
        let room = self.proportions.dcm_error_of_push;
        let is_pushed = self.external_acceleration().amax() > EXTERNAL_OF_PUSH;
        let is_calm = !is_pushed && error.amax() < room && evidence.zmp.is_some_and(|zmp| zmp.amax() < 2.0 * room);
        self.learns_offset = evidence.is_flat && is_calm && self.since_restart > SETTLED;
        self.correct(&Vector3::new(1.0, 0.0, 0.0), velocity, VELOCITY_NOISE);
        if let (Some(acceleration), Some(zmp)) = (evidence.acceleration, evidence.zmp) {
            let unexplained = acceleration - (self.state.position - zmp) * self.stiffness;
            self.correct(&Vector3::new(0.0, -self.stiffness, 1.0), unexplained, ACCELERATION_NOISE);
        }
        let max = self.proportions.com_offset_max;
        self.set_row(OFFSET, self.com_offset().map(|offset| offset.min(max).max(-max)));
        if self.candidate.is_none_or(|(_, age)| age >= TRUSTED_AGE) {
            self.trusted = self.candidate.or(Some((self.state, 0.0)));
            self.candidate = Some((self.state, 0.0));
        }
    }

    /// A sensor was found to be wrong: returns to the state before it was.
    pub fn distrust(&mut self) {
        if let Some((state, age)) = self.trusted {
            self.state = self.moved(&state, age);
            self.candidate = None;
        }
    }

    /// The support changes: place and velocity are measured anew. The offset turns with the robot, the force does not.
    ///
    /// * `heading` – of the new support foot against the former one: a unit vector in its coordinates
    pub fn change_support(&mut self, heading: Vector2<f64>) {
        let (offset, force) = (self.com_offset(), self.external_acceleration());
        let aside = Vector2::new(-heading.y, heading.x);
        let variance = self.covariance[(EXTERNAL, EXTERNAL)];
        self.restart();
        self.set_row(OFFSET, Vector2::new(offset.x, -offset.y));
        self.set_row(EXTERNAL, Vector2::new(heading.dot(&force), -aside.dot(&force)));
        self.covariance[(EXTERNAL, EXTERNAL)] = variance;
    }

    /// The robot is not where it was: place, velocity and force are measured anew. The offset stays.
    pub fn restart(&mut self) {
        let (offset, variance) = (self.com_offset(), self.covariance[(OFFSET, OFFSET)]);
        self.state = Deviation::default();
        self.set_row(OFFSET, offset);
        self.covariance = Matrix3::from_diagonal(&UNKNOWN.component_mul(&UNKNOWN));
        self.covariance[(OFFSET, OFFSET)] = variance;
        self.zmp = None;
        (self.trusted, self.candidate) = (None, None);
        self.unmeasured_for = f64::INFINITY;
        self.since_restart = 0.0;
    }

    /// The centre of mass now, its offset taken out; `None` when the last measurement is too old, or there is none.
    ///
    /// * `planned` – the centre of mass now, as planned
    pub fn com(&self, planned: &ComState) -> Option<ComState> {
        let position = self.state.position - self.com_offset();
        (self.unmeasured_for < BRIDGED_MAX).then(|| ComState {
            position: planned.position + position.push(0.0),
            velocity: planned.velocity + self.state.velocity.push(0.0),
        })
    }

    /// By how much the centre of mass seems to be farther ahead and to the left than it is (m).
    pub fn com_offset(&self) -> Vector2<f64> {
        self.row(OFFSET)
    }

    /// Acceleration by an external force (m/s²).
    pub fn external_acceleration(&self) -> Vector2<f64> {
        self.row(EXTERNAL)
    }

    fn row(&self, row: usize) -> Vector2<f64> {
        self.state.filtered.row(row).transpose()
    }

    fn set_row(&mut self, row: usize, value: Vector2<f64>) {
        self.state.filtered.set_row(row, &value.transpose());
    }

    /// How velocity, offset and external acceleration change within `dt` (s), but for place and zero-moment point.
    fn transition(&self, dt: f64) -> Matrix3<f64> {
        let stiffness = if self.zmp.is_some() { self.stiffness } else { 0.0 };
        let fades = EXTERNAL_TIME_CONSTANT / (EXTERNAL_TIME_CONSTANT + dt);
        Matrix3::new(1.0, -stiffness * dt, dt, 0.0, 1.0, 0.0, 0.0, 0.0, fades)
    }

    /// A state `dt` (s) later.
    fn moved(&self, state: &Deviation, dt: f64) -> Deviation {
        let mut filtered = self.transition(dt) * state.filtered;
        if let Some(zmp) = self.zmp {
            let driven = (state.position - zmp) * (self.stiffness * dt);
            filtered.set_row(VELOCITY, &(filtered.row(VELOCITY) + driven.transpose()));
        }
        let velocity = state.velocity + (filtered.row(VELOCITY) - state.filtered.row(VELOCITY)).transpose();
        Deviation { position: state.position + velocity * dt, velocity, filtered }
    }

    /// Corrects the state by a value of each axis that is a sum of its rows.
    fn correct(&mut self, sum: &Vector3<f64>, value: Vector2<f64>, noise: f64) {
        let variance = noise * noise;
        let spread = self.covariance * sum;
        let mut gain = spread / (sum.dot(&spread) + variance);
        if !self.learns_offset {
            gain[OFFSET] = 0.0;
        }
        let innovation = value.transpose() - sum.transpose() * self.state.filtered;
        self.state.filtered += gain * innovation;
        // Joseph's form holds for every gain.
        let kept = Matrix3::identity() - gain * sum.transpose();
        self.covariance = kept * self.covariance * kept.transpose() + gain * gain.transpose() * variance;
    }
}

#[cfg(test)]
mod tests {
    use config::Config;

    use super::*;

    const PERIOD: f64 = 1e-3;
    const HEIGHT: f64 = 0.9;

    /// A robot whose plan is to stand still over the origin.
    const PLANNED: ComState =
        ComState { position: Vector3::new(0.0, 0.0, HEIGHT), velocity: Vector3::new(0.0, 0.0, 0.0) };

    fn filter() -> ComFilter {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/mechanism.toml");
        let mut filter = ComFilter::new(&Mechanism::load(file).unwrap());
        filter.since_restart = SETTLED;
        filter
    }

    /// A linear inverted pendulum whose ZMP follows its divergent component, while it sways.
    struct Pendulum {
        com: ComState,
        time: f64,
    }

    impl Pendulum {
        fn new() -> Self {
            Self { com: PLANNED, time: 0.0 }
        }

        /// Moves on under an external acceleration: the ZMP and the acceleration.
        fn advance(&mut self, external: Vector2<f64>, dt: f64) -> [Vector2<f64>; 2] {
            let sway = Vector2::new((4.0 * self.time).sin(), (3.0 * self.time).cos()) * 0.005;
            let zmp = self.com.divergent_component() * 1.5 + sway;
            let acceleration = (self.com.position.xy() - zmp) * self.com.pendulum_rate().powi(2) + external;
            self.com.position += (self.com.velocity + acceleration.push(0.0) * (dt / 2.0)) * dt;
            self.com.velocity += acceleration.push(0.0) * dt;
            self.time += dt;
            [zmp, acceleration]
        }
    }

    /// What is measured of the pendulum, with its place off by an offset.
    fn absorb(
        filter: &mut ComFilter,
        pendulum: &Pendulum,
        offset: Vector2<f64>,
        [zmp, acceleration]: [Vector2<f64>; 2],
    ) {
        let com = ComState { position: pendulum.com.position + offset.push(0.0), velocity: pendulum.com.velocity };
        filter.absorb(
            &com,
            &PLANNED,
            &AccelerationEvidence { zmp: Some(zmp), acceleration: Some(acceleration), is_flat: true },
        );
    }

    #[test]
    fn a_constant_offset_converges_to_the_truth() {
        let offset = Vector2::new(0.018, -0.012);
        let (mut filter, mut pendulum) = (filter(), Pendulum::new());
        for _ in 0..30_000 {
            let ground = pendulum.advance(Vector2::zeros(), PERIOD);
            filter.advance(PERIOD);
            absorb(&mut filter, &pendulum, offset, ground);
        }
        assert!((filter.com_offset() - offset).norm() < 5e-4, "{}", filter.com_offset());
        let com = filter.com(&PLANNED).unwrap();
        assert!((com.position - pendulum.com.position).norm() < 5e-4, "{com:?}");
    }

    #[test]
    fn a_push_is_an_external_force_and_no_offset() {
        let (mut filter, mut pendulum) = (filter(), Pendulum::new());
        let push = Vector2::new(1.5, -1.0);
        let mut largest = Vector2::zeros();
        for tick in 0..3000 {
            let external = if (2000..2100).contains(&tick) { push } else { Vector2::zeros() };
            let ground = pendulum.advance(external, PERIOD);
            filter.advance(PERIOD);
            absorb(&mut filter, &pendulum, Vector2::zeros(), ground);
            if tick == 2099 {
                largest = filter.external_acceleration();
            }
            assert!(filter.com_offset().norm() < 5e-3, "tick {tick}: {}", filter.com_offset());
        }
        assert!((largest - push).norm() < 0.3 * push.norm(), "{largest}");
        assert!(filter.external_acceleration().norm() < 0.05, "{}", filter.external_acceleration());
    }

    /// The oracle: the pendulum itself, whose samples are missing for 20 ms.
    #[test]
    fn missing_samples_are_bridged_by_the_pendulum() {
        let (mut filter, mut pendulum) = (filter(), Pendulum::new());
        for _ in 0..2000 {
            let ground = pendulum.advance(Vector2::zeros(), PERIOD);
            filter.advance(PERIOD);
            absorb(&mut filter, &pendulum, Vector2::zeros(), ground);
        }
        for tick in 0..49 {
            pendulum.advance(Vector2::zeros(), PERIOD);
            filter.advance(PERIOD);
            let com = filter.com(&PLANNED).unwrap();
            let apart = (com.divergent_component() - pendulum.com.divergent_component()).norm();
            assert!(apart < 1e-3 + 4e-4 * f64::from(tick), "tick {tick}: {apart} m");
        }
        filter.advance(2.0 * PERIOD);
        assert!(filter.com(&PLANNED).is_none(), "what is older is not known");
    }

    #[test]
    fn samples_before_a_fault_was_noticed_are_taken_back() {
        let (mut filter, mut pendulum) = (filter(), Pendulum::new());
        let mut wrong = Vector2::zeros();
        for tick in 0..1000 {
            let ground = pendulum.advance(Vector2::zeros(), PERIOD);
            filter.advance(PERIOD);
            wrong = if tick > 996 { Vector2::new(0.1, 0.0) } else { Vector2::zeros() };
            absorb(&mut filter, &pendulum, wrong, ground);
        }
        assert!((filter.com(&PLANNED).unwrap().position - pendulum.com.position).norm() > 0.5 * wrong.norm());
        filter.distrust();
        assert!((filter.com(&PLANNED).unwrap().position - pendulum.com.position).norm() < 1e-3);
    }

    #[test]
    fn an_offset_turns_with_the_robot_and_a_force_stays_in_the_world() {
        let mut filter = filter();
        filter.set_row(OFFSET, Vector2::new(0.01, 0.02));
        filter.set_row(EXTERNAL, Vector2::new(1.0, 0.5));
        let turn = nalgebra::Rotation2::new(0.3);
        filter.change_support(turn * Vector2::x());
        assert_eq!(filter.com_offset(), Vector2::new(0.01, -0.02));
        let force = filter.external_acceleration();
        let seen_from_the_left = Vector2::new(force.x, -force.y);
        assert!((turn * seen_from_the_left - Vector2::new(1.0, 0.5)).norm() < 1e-12);
        assert!(filter.com(&PLANNED).is_none(), "its place over the other foot is still to be measured");
    }

    #[test]
    fn a_robot_that_tips_teaches_no_offset() {
        let (mut filter, mut pendulum) = (filter(), Pendulum::new());
        for _ in 0..3000 {
            let [zmp, acceleration] = pendulum.advance(Vector2::zeros(), PERIOD);
            filter.advance(PERIOD);
            let com = ComState { position: pendulum.com.position + Vector3::new(0.02, 0.0, 0.0), ..pendulum.com };
            let evidence = AccelerationEvidence { zmp: Some(zmp), acceleration: Some(acceleration), is_flat: false };
            filter.absorb(&com, &PLANNED, &evidence);
        }
        assert_eq!(filter.com_offset(), Vector2::zeros());
    }
}
