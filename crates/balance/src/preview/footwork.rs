//! Footwork: what the half-steps ask of the body at a knot, apart from where its centre of mass goes.

use dynamics::{Kinematics, Leg, UpperBody, atan2};
use model::{JointVector, Mechanism, Side};
use nalgebra::{Vector2, Vector3};

use crate::preview::{Biped, Course, Event, HipHeight, KNOT, LandingShift, SolePose, SwingPath, Wanted};

/// The course at a knot, with the paths of the swinging sole and of the hips' height.
#[derive(Clone, Debug)]
pub struct Footwork {
    /// Which half-steps, and where they put the feet.
    pub course: Course,
    swing: SwingPath,
    shift: LandingShift,
    hips: HipHeight,
    /// Between the soles' middles at least [m].
    soles_apart: f64,
}

/// How far a landing is shifted at most, ahead or back and outward [m].
const SHIFT_MAX: Vector2<f64> = Vector2::new(0.2, 0.15);
/// Between the soles' edges at least, side by side [m]: 2 cm, and some for turned feet.
const SOLES_APART: f64 = 0.04;
/// What is not worth another plan [m].
const SHIFT_STEP: f64 = 0.008;

const PELVIS: model::Joint = Leg(Side::Right).end();

impl Footwork {
    /// At the present knot of a course.
    pub fn new(biped: &Biped, course: Course) -> Self {
        Self {
            swing: swing_path(biped, &course),
            shift: LandingShift::default(),
            hips: HipHeight::new(biped, &course.walk),
            soles_apart: 2.0 * biped.mechanism.sole.half_width + SOLES_APART,
            course,
        }
    }

    /// Moves on by a knot and says whether a half-step began.
    pub fn advance(&mut self, biped: &Biped) -> bool {
        let Self { course, swing, shift, hips, .. } = self;
        let event = course.advance(biped);
        if event != Event::None {
            *swing = swing_path(biped, course);
            *shift = LandingShift::default();
        }
        if event == Event::Swap {
            let speed = course.walk.speed().target().min(course.walk.speed().state().value);
            let half_duration = 0.5 * course.walk.table().duration / speed / biped.sway.height_over_gravity.sqrt();
            hips.begin_half_step(half_duration, |progress| swing.at(progress, &course.swinging_sole(biped, progress)));
        }
        if course.gate.is_standing() {
            hips.crouch(&course.feet.standing, course.gate.shifted());
        }
        event == Event::Swap
    }

    /// Lands the swinging foot `shift` off where the walk asks, in support coordinates [m], as far as feet and legs let it;
    /// says whether that changed anything. Nothing changes late in a half-step or before a stand.
    pub fn shift_landing(&mut self, shift: Vector2<f64>) -> bool {
        if !self.is_worth_shifting(shift) {
            return false;
        }
        let shift = self.within_reach(shift);
        let landing = self.unshifted_landing() + shift;
        (self.course.feet.landing.position.x, self.course.feet.landing.position.y) = (landing.x, landing.y);
        self.shift.retarget(self.course.walk.half_step().progress, shift);
        true
    }

    /// Whether [`shift_landing`](Self::shift_landing) would change anything.
    pub fn is_worth_shifting(&self, shift: Vector2<f64>) -> bool {
        let is_new = (self.within_reach(shift) - self.shift.target()).amax() > SHIFT_STEP;
        is_new && self.course.gate.walks() && LandingShift::is_in_time(self.course.walk.half_step().progress)
    }

    fn unshifted_landing(&self) -> Vector2<f64> {
        self.course.feet.landing.position.xy() - self.shift.target()
    }

    fn within_reach(&self, shift: Vector2<f64>) -> Vector2<f64> {
        let inward = (self.soles_apart - self.unshifted_landing().y).min(0.0);
        Vector2::new(shift.x.clamp(-SHIFT_MAX.x, SHIFT_MAX.x), shift.y.clamp(inward, SHIFT_MAX.y))
    }

    /// How many knots are left of the half-step at the present speed.
    pub fn knots_left(&self) -> f64 {
        let left = (1.0 - self.course.walk.half_step().progress) * self.course.walk.table().duration;
        left / self.course.walk.speed().state().value / KNOT
    }

    /// The posture that has the centre of mass at `com` in the walk frame [m].
    pub fn wanted(&self, biped: &Biped, com: Vector2<f64>) -> Wanted {
        let progress = self.course.walk.half_step().progress;
        let other_foot = Mechanism::foot(Side::Left);
        let nominal = self.course.walk.table().angles_at(progress);
        let asked = nominal + self.course.walk.offsets_at(progress);
        let asked = Kinematics::standing_up_to(&biped.tree, &asked, other_foot);
        let pelvis_ahead = asked.rotation[PELVIS].column(0).into_owned();
        let mut swinging = self.swing.at(progress, &SolePose::swinging(&biped.mechanism, &asked));
        let [shift, ..] = self.shift.at(progress);
        swinging.position += Vector3::new(shift.x, shift.y, 0.0);
        Wanted {
            com: self.course.feet.footprint.point_to_support(com),
            hip_height: Kinematics::standing_up_to(&biped.tree, &nominal, PELVIS).origin[PELVIS].z
                - self.hips.lowered(progress),
            pelvis_yaw: atan2(pelvis_ahead.y, pelvis_ahead.x),
            swinging,
            upper: nominal,
            carried: UpperBody::new(&biped.tree, &nominal),
        }
    }

    /// Tells angles of support coordinates in physical joints, or the other way round.
    pub fn physical(&self, biped: &Biped, angles: &JointVector) -> JointVector {
        match self.course.feet.footprint.side {
            Side::Right => *angles,
            Side::Left => biped.mirror.apply(angles),
        }
    }

    /// Half-steps since the beginning, with their progress.
    pub fn place(&self) -> f64 {
        let half_step = self.course.walk.half_step();
        half_step.index as f64 + half_step.progress
    }

    /// The speed factor, 0 in a stand.
    pub fn speed(&self) -> f64 {
        if self.course.gate.is_standing() { 0.0 } else { self.course.walk.speed().state().value }
    }
}

fn swing_path(biped: &Biped, course: &Course) -> SwingPath {
    let asked = |progress| course.swinging_sole(biped, progress);
    SwingPath::new(&course.feet.standing, &course.feet.landing, asked)
}
