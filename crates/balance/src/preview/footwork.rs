//! Footwork: what the half-steps ask of the body at a knot, apart from where its centre of mass goes.

use dynamics::{Kinematics, Leg, atan2};
use model::{JointVector, Mechanism, Side};
use nalgebra::Vector2;

use crate::preview::{Biped, Course, HipHeight, SolePose, SwingPath, Wanted};

/// The course at a knot, with the paths of the swinging sole and of the hips' height.
#[derive(Clone, Debug)]
pub struct Footwork {
    /// Which half-steps, and where they put the feet.
    pub course: Course,
    swing: SwingPath,
    hips: HipHeight,
}

const PELVIS: model::Joint = Leg(Side::Right).end();

impl Footwork {
    /// At the present knot of a course.
    pub fn new(biped: &Biped, course: Course) -> Self {
        Self { swing: swing_path(biped, &course), hips: HipHeight::new(biped, &course.walk), course }
    }

    /// Moves on by a knot and says whether a half-step began.
    pub fn advance(&mut self, biped: &Biped) -> bool {
        let Self { course, swing, hips } = self;
        let begins = course.advance(biped);
        if begins {
            *swing = swing_path(biped, course);
            let speed = course.walk.speed().target().min(course.walk.speed().state().value);
            let half_duration = 0.5 * course.walk.table().duration / speed / biped.sway.height_over_gravity.sqrt();
            hips.begin_half_step(half_duration, |progress| swing.at(progress, &course.swinging_sole(biped, progress)));
        }
        if course.gate.is_standing() {
            hips.crouch(&course.feet.standing, course.gate.shifted());
        }
        begins
    }

    /// The posture that has the centre of mass at `com` in the walk frame [m].
    pub fn wanted(&self, biped: &Biped, com: Vector2<f64>) -> Wanted {
        let progress = self.course.walk.half_step().progress;
        let other_foot = Mechanism::foot(Side::Left);
        let angles = self.course.walk.angles();
        let asked = Kinematics::standing_up_to(&biped.tree, &angles, other_foot);
        let nominal = self.course.walk.table().at(progress).angles;
        let pelvis_ahead = asked.rotation[PELVIS].column(0).into_owned();
        Wanted {
            com: self.course.feet.footprint.point_to_support(com),
            hip_height: Kinematics::standing_up_to(&biped.tree, &nominal, PELVIS).origin[PELVIS].z
                - self.hips.lowered(progress),
            pelvis_yaw: atan2(pelvis_ahead.y, pelvis_ahead.x),
            swinging: self.swing.at(progress, &SolePose::swinging(&biped.mechanism, &asked)),
            upper: nominal,
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
