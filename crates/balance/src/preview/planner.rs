//! The preview compensator: keeps the modified feet, plans the centre of mass over them, realises both with the legs.

use std::sync::Arc;

use dynamics::Kinematics;
use gait::{Admission, Command, HalfStep, Request, Walk};
use model::{GRAVITY, Joint, Mechanism, Motion, Side};
use nalgebra::Vector2;

use crate::preview::{
    Biped, CartState, Change, Course, Draft, Floor, Footprint, Footwork, Foresight, Gate, Goal, Height, Knot, Playback,
    WholeBody,
};

/// Time between knots [s].
pub const KNOT: f64 = 0.01;

/// A new landing is a new plan: not more often than this.
const KNOTS_BETWEEN_SHIFTS: u32 = 5;

/// A walk whose centre of mass is planned. Takes the place of the plain [`Walk`].
#[derive(Clone, Debug)]
pub struct Preview {
    biped: Arc<Biped>,
    /// At the newest knot.
    footwork: Footwork,
    foresight: Foresight,
    draft: Draft,
    /// What the whole body needs besides the pendulum's plan.
    correction: [CartState; 2],
    body: WholeBody,
    /// How the floor tilts.
    floor: Floor,
    height: Height,
    /// How the body is turned beyond the plan, about x and y of support coordinates [rad].
    tilt: Vector2<f64>,
    playback: Playback,
    /// Counts what was planned.
    stamp: u64,
    /// Knots since the landing was shifted last.
    since_shift: u32,
    unreachable: bool,
}

impl Preview {
    /// A walk in stride, at the very beginning of its first half-step.
    pub fn new(mechanism: &Mechanism, walk: Walk) -> Self {
        let biped = Biped::new(mechanism, walk.mirror(), walk.table());
        let motion = walk.motion();
        let footwork = Footwork::new(&biped, Course::new(&biped, walk));
        Self::begin(biped, footwork, &motion)
    }

    /// A stand with the feet side by side, from which a walk can be started.
    pub fn standing(mechanism: &Mechanism, walk: Walk) -> Self {
        let biped = Biped::new(mechanism, walk.mirror(), walk.table());
        let nominal = walk.motion().angles;
        let footwork = Footwork::new(&biped, Course::standing(&biped, walk));
        let feet = &footwork.course.feet;
        let middle = feet.footprint.point_to_walk(feet.standing.position.xy() / 2.0);
        let posture = WholeBody::new(&biped, &nominal).reach(&biped, &footwork.wanted(&biped, middle));
        Self::begin(biped, footwork, &Motion::at_rest(posture.unwrap_or(nominal)))
    }

    /// Begins with a motion, told in support coordinates.
    fn begin(biped: Biped, footwork: Footwork, motion: &Motion) -> Self {
        let kinematics = Kinematics::standing(&biped.tree, &motion.angles);
        let com = cart_states(
            &footwork.course.feet.footprint,
            kinematics.com(&biped.tree).xy(),
            kinematics.com_velocity(&biped.tree, &motion.rates).0.xy(),
            Vector2::zeros(),
        );
        let knot = Knot {
            angles: footwork.physical(&biped, &motion.angles),
            footprint: footwork.course.feet.footprint,
            place: footwork.place(),
            speed: footwork.speed(),
            vertical: Vector2::zeros(),
            weight: footwork.course.gate.weight_on_bearing(),
        };
        let foresight = Foresight::new(&biped, &footwork, com, motion);
        let mut preview = Self {
            draft: Draft::none(&footwork, &foresight),
            foresight,
            correction: [CartState::zeros(); 2],
            body: WholeBody::new(&biped, &motion.angles),
            floor: Floor::default(),
            height: Height::default(),
            tilt: Vector2::zeros(),
            playback: Playback::new([knot; 4]),
            stamp: 0,
            since_shift: 0,
            unreachable: false,
            biped: Arc::new(biped),
            footwork,
        };
        // The second knot is the beginning; before it the motion came as it goes on.
        let before = preview.footwork.physical(&preview.biped, &(motion.angles - motion.rates * KNOT));
        let place = knot.place - knot.speed * KNOT / preview.walk().table().duration;
        preview.plan_knot();
        let next = *preview.playback.newest();
        preview.plan_knot();
        preview.playback =
            Playback::new([Knot { angles: before, place, ..knot }, knot, next, *preview.playback.newest()]);
        preview
    }

    /// Goes on as `other`, a copy of this with something else asked of it, at the same instant.
    pub fn follow(&mut self, other: &Self) {
        let Self { playback, floor, height, tilt, since_shift, .. } = *self;
        *self = Self { playback, floor, height, tilt, since_shift, ..other.clone() };
        self.playback.is_planned(self.walk().command().speed);
    }

    /// Another number whenever the plan has changed: copies of the same number are the same but for the instant.
    pub fn stamp(&self) -> u64 {
        self.stamp
    }

    /// Plays a speed that is asked for from now on, if half-steps are walked; to be followed by a plan for it.
    pub fn hasten(&mut self, request: &Request) {
        let course = &self.footwork.course;
        let target = course.walk.grant(request, course.command()).granted.speed;
        if course.gate == Gate::Open && target != course.walk.speed().target() {
            self.playback.hasten(course.walk.speed(), target);
        }
    }

    /// Plays no other speed than planned: none was granted.
    pub fn keep_pace(&mut self) {
        self.playback.keep_pace();
    }

    /// See [`Course::admit`].
    pub fn admit(&mut self, request: &Request) -> Admission {
        let before = self.footwork.course.command();
        let admission = self.footwork.course.admit(request);
        let walk = &mut self.footwork.course.walk;
        let speed = walk.speed().target();
        if speed != before.speed
            && let Some(pace) = self.playback.pace_at_newest(speed)
        {
            walk.take_over_speed(pace);
        }
        if self.footwork.course.command() != before {
            self.look_ahead();
        }
        admission
    }

    /// Walks on, steps in place or comes to a stand: at once. Costs the time of a look ahead; see [`Preview::aim_soon`].
    pub fn aim(&mut self, goal: Goal) {
        let before = self.gate();
        let Change { goal: overruled, .. } = self.draft.change();
        self.footwork.course.aim(goal);
        if self.gate() != before || overruled.is_some_and(|overruled| overruled != goal) {
            self.draft.forget_goal();
            self.look_ahead();
        }
    }

    /// The same within two knots, the look ahead spread over the ticks until then.
    pub fn aim_soon(&mut self, goal: Goal) {
        self.change_soon(Change { goal: Some(goal), shift: None });
    }

    /// Whether it walks, stands or is about to, at the newest knot.
    pub fn gate(&self) -> Gate {
        self.footwork.course.gate
    }

    /// What is to come has changed: plays it anew. Not done for a stream that asks the same again and again.
    fn look_ahead(&mut self) {
        // What was in the making is made at once.
        self.draft.take().apply(&mut self.footwork);
        self.foresight.begin(&self.biped, &self.footwork);
        self.stamp += 1;
    }

    /// Has something changed by the time it is played ahead; says whether there is anything to change.
    fn change_soon(&mut self, change: Change) -> bool {
        let Self { biped, footwork, foresight, draft, playback, .. } = self;
        let changes = draft.begin(biped, footwork, foresight, change, playback.elapsed());
        if changes {
            self.stamp += 1;
        }
        changes
    }

    /// What is in force, or will be when the walk goes on.
    pub fn command(&self) -> Command {
        self.footwork.course.command()
    }

    /// Moves on by `dt` [s], at most a nominal half-step, and says whether a new half-step began.
    pub fn advance(&mut self, dt: f64) -> bool {
        let before = self.half_step().index;
        let dt = dt.min(self.footwork.course.walk.table().duration).max(0.0);
        self.playback.advance(dt);
        while self.playback.passes_knot() {
            self.plan_knot();
        }
        let elapsed = self.playback.elapsed();
        self.foresight.keep_up(&self.biped, elapsed / KNOT);
        self.draft.work(&self.biped, elapsed, dt);
        self.half_step().index != before
    }

    /// Where the walk is now.
    pub fn half_step(&self) -> HalfStep {
        self.playback.half_step(self.footwork.course.walk.half_step())
    }

    /// The speed factor of now.
    pub fn speed(&self) -> f64 {
        self.playback.speed()
    }

    /// Share of the weight that the bearing foot is to carry now.
    pub fn weight_on_bearing(&self) -> f64 {
        self.playback.weight_on_bearing()
    }

    /// What is asked now, in physical joints.
    pub fn physical_motion(&self) -> Motion {
        self.playback.physical_motion()
    }

    /// What is asked now, in support coordinates. Joints 1 and 2 tell how the sole lies on a slope.
    pub fn motion(&self) -> Motion {
        let mut motion = match self.half_step().support {
            Side::Right => self.physical_motion(),
            Side::Left => self.physical_motion().mirrored(self.footwork.course.walk.mirror()),
        };
        let [vertical, rate] = self.playback.vertical().map(|vertical| self.footprint().direction_to_support(vertical));
        // The turn that brings the vertical upright.
        (motion.angles[Joint::FootRoll], motion.angles[Joint::FootPitch]) = (vertical.y, -vertical.x);
        (motion.rates[Joint::FootRoll], motion.rates[Joint::FootPitch]) = (rate.y, -rate.x);
        motion
    }

    /// Lands the swinging foot where it catches the robot.
    ///
    /// * `excess` – by a factor of growth until touchdown: how far off its place the divergent component will be then, beyond
    ///   what ankles can do, in support coordinates [m]
    pub fn catch(&mut self, excess: impl Fn(f64) -> Vector2<f64>) {
        if self.walk().half_step().index != self.half_step().index || self.since_shift < KNOTS_BETWEEN_SHIFTS {
            return;
        }
        let knots = self.footwork.knots_left() as i32;
        let growth = (1.0 + KNOT / self.biped.sway.height_over_gravity.sqrt()).powi(knots);
        let shift = excess(growth);
        if self.footwork.is_worth_shifting(shift) && self.change_soon(Change { goal: None, shift: Some(shift) }) {
            self.since_shift = 0;
        }
    }

    /// Absorbs how the vertical leans over the bearing sole, in support coordinates, `dt` seconds after the last time.
    pub fn sense_vertical(&mut self, lean: Vector2<f64>, dt: f64) {
        self.floor.sense(self.footprint().direction_to_walk(lean), dt);
    }

    /// Absorbs how the body is turned beyond the plan, about x and y of support coordinates [rad].
    pub fn sense_tilt(&mut self, tilt: Vector2<f64>) {
        // The newest knot is a little ahead: just before a swap it is told from the other foot.
        if self.walk().half_step().index == self.half_step().index {
            self.tilt = tilt;
        }
    }

    /// How the vertical leans over the floor as soles now tell, in support coordinates: x and y of the unit vector [-]. The
    /// plan follows slowly.
    pub fn vertical_now(&self) -> Vector2<f64> {
        self.footprint().direction_to_support(self.floor.lean_now())
    }

    /// The foot that bears now.
    fn footprint(&self) -> &Footprint {
        self.playback.footprint(self.half_step().support)
    }

    /// Whether a leg was too short at the newest knot, so that the posture before was kept.
    pub fn is_out_of_reach(&self) -> bool {
        self.unreachable
    }

    /// The walk that is asked for, at the newest knot.
    pub fn walk(&self) -> &Walk {
        &self.footwork.course.walk
    }

    /// The robot as a tree.
    pub fn tree(&self) -> &dynamics::Tree {
        &self.biped.tree
    }

    /// Plans and realises one more knot.
    fn plan_knot(&mut self) {
        self.since_shift = self.since_shift.saturating_add(1);
        let biped = &*self.biped;
        self.foresight.complete(biped);
        let wanted = self.foresight.weighed();
        self.correction = [0, 1].map(|axis| biped.correction.advance(&self.correction[axis], wanted[axis]));
        self.foresight.advance();
        if self.footwork.advance(biped) {
            self.body.swap(biped);
            self.height.swap();
            // Turned the same, seen in the mirror.
            self.tilt.x = -self.tilt.x;
        }
        if let Some((footwork, foresight)) = self.draft.due(biped) {
            self.footwork.clone_from(footwork);
            self.foresight.clone_from(foresight);
        }

        self.floor.advance(KNOT);
        let uphill = self.floor.lean() * (biped.sway.height_over_gravity * GRAVITY);
        let correction = Vector2::new(self.correction[0].x, self.correction[1].x) + uphill;
        let mut wanted = self.foresight.wanted(&self.footwork.course.feet.footprint, correction);
        self.height.advance(self.tilt, wanted.swinging.position.xy(), KNOT);
        wanted.swinging.position.z += self.height.of_sole();
        wanted.hip_height += self.height.of_hips();
        let reached = self.body.reach(biped, &wanted);
        self.unreachable = reached.is_err();
        let angles = reached.map_or(self.playback.newest().angles, |angles| self.footwork.physical(biped, &angles));
        self.playback.push(Knot {
            angles,
            footprint: self.footwork.course.feet.footprint,
            place: self.footwork.place(),
            speed: self.footwork.speed(),
            vertical: self.floor.lean(),
            weight: self.footwork.course.gate.weight_on_bearing(),
        });
        self.stamp += 1;
    }
}

/// Position, velocity and acceleration told in the walk's frame, along x and along y.
fn cart_states(
    footprint: &Footprint,
    position: Vector2<f64>,
    velocity: Vector2<f64>,
    acceleration: Vector2<f64>,
) -> [CartState; 2] {
    let position = footprint.point_to_walk(position);
    let velocity = footprint.direction_to_walk(velocity);
    let acceleration = footprint.direction_to_walk(acceleration);
    [0, 1].map(|axis| CartState::new(position[axis], velocity[axis], acceleration[axis]))
}
