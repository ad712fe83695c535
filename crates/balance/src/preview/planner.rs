//! The preview compensator: keeps the modified feet, plans the centre of mass over them, realises both with the legs.

use dynamics::{Kinematics, Tree};
use gait::{Admission, Command, HalfStep, Request, Walk};
use model::{JointVector, Mechanism, Motion, Side};
use nalgebra::Vector2;

use crate::preview::{
    CartState, CartTable, Feet, Footprint, Gate, HipHeight, NominalSway, Outlook, SolePose, SwingPath, Wanted,
    WholeBody, swinging_sole,
};

/// Time between knots [s].
pub const KNOT: f64 = 0.01;
/// Knots looked ahead: 1.8 s, e^(−6) of the pendulum.
const KNOTS_AHEAD: usize = 180;
/// What a jerk costs against a ZMP error [m²/(m/s³)²].
const JERK_WEIGHT: f64 = 1e-8;

/// A walk whose centre of mass is planned. Takes the place of the plain [`Walk`].
#[derive(Clone, Debug)]
pub struct Preview {
    mechanism: Mechanism,
    tree: Tree,
    cart: CartTable,
    outlook: Outlook,
    /// The walk at the newest knot.
    walk: Walk,
    gate: Gate,
    /// The feet at the newest knot.
    feet: Feet,
    swing: SwingPath,
    hips: HipHeight,
    com: [CartState; 2],
    body: WholeBody,
    /// The last four knots, oldest first; now is between the second and the third.
    knots: [Knot; 4],
    /// Since the second knot [s].
    elapsed: f64,
    unreachable: bool,
}

/// One realised instant.
#[derive(Clone, Copy, Debug)]
struct Knot {
    /// Physical joints.
    angles: JointVector,
    /// Half-steps since the beginning, with their progress.
    place: f64,
    speed: f64,
    /// Share of the weight that the bearing foot carries.
    weight: f64,
}

impl Preview {
    /// A walk at its very beginning.
    pub fn new(mechanism: &Mechanism, walk: Walk) -> Self {
        let tree = Tree::new(mechanism);
        let sway = NominalSway::new(&tree, walk.table());
        let cart = CartTable::new(sway.height_over_gravity, KNOT, KNOTS_AHEAD, JERK_WEIGHT);
        let motion = walk.motion();
        let kinematics = Kinematics::standing(&tree, &motion.angles);
        let footprint = Footprint::first(walk.half_step().support);
        let com = kinematics.com(&tree).xy();
        let com_velocity = kinematics.com_velocity(&tree, &motion.rates).0.xy();
        let standing = SolePose::swinging(mechanism, &kinematics);
        let swing = SwingPath::new(&standing, |progress| swinging_sole(&tree, mechanism, &walk, progress));
        let feet = Feet { footprint, standing, landing: swing.landing };
        let gate = Gate::Open;
        let outlook = Outlook::new(sway, &tree, mechanism, &walk, &feet, gate, cart.knots());
        let knot = Knot {
            angles: walk.physical_motion().angles,
            place: walk.half_step().progress,
            speed: walk.speed().state().value,
            weight: 1.0,
        };
        let mut preview = Self {
            mechanism: mechanism.clone(),
            body: WholeBody::new(&tree, &motion.angles),
            hips: HipHeight::new(&tree, mechanism, &walk),
            com: cart_states(&footprint, com, com_velocity, Vector2::zeros()),
            knots: [knot; 4],
            elapsed: 0.0,
            unreachable: false,
            tree,
            cart,
            outlook,
            walk,
            gate,
            feet,
            swing,
        };
        // The second knot is the beginning; before it the motion came as it goes on.
        preview.plan_knot();
        let first = &mut preview.knots;
        first[2] = first[3];
        preview.plan_knot();
        let before = motion.angles - motion.rates * KNOT;
        preview.knots[0] = Knot {
            angles: match footprint.side {
                Side::Right => before,
                Side::Left => preview.walk.mirror().apply(&before),
            },
            place: knot.place - knot.speed * KNOT / preview.walk.table().duration,
            ..knot
        };
        preview.knots[1] = knot;
        preview
    }

    /// See [`Walk::admit`].
    pub fn admit(&mut self, request: &Request) -> Admission {
        let before = self.walk.command();
        let admission = self.walk.admit(request);
        if self.walk.command() != before {
            self.look_ahead();
        }
        admission
    }

    /// Stops at the end of this half-step and stands on both feet.
    pub fn stop(&mut self) {
        let before = self.gate;
        self.gate.close(self.walk.half_step().progress);
        if self.gate != before {
            self.look_ahead();
        }
    }

    /// Walks on, after a stand with a shift of weight first.
    pub fn start(&mut self) {
        let before = self.gate;
        self.gate.open();
        if self.gate != before {
            self.look_ahead();
        }
    }

    /// Whether it walks, stands or is about to, at the newest knot.
    pub fn gate(&self) -> Gate {
        self.gate
    }

    /// What is to come has changed: plays it anew. Not done for a stream that asks the same again and again.
    fn look_ahead(&mut self) {
        self.outlook.begin(&self.tree, &self.mechanism, &self.walk, &self.feet, self.gate);
    }

    /// What is in force.
    pub fn command(&self) -> Command {
        self.walk.command()
    }

    /// Moves on by `dt` [s], at most a nominal half-step, and says whether a new half-step began.
    pub fn advance(&mut self, dt: f64) -> bool {
        let before = self.half_step().index;
        self.elapsed += dt.min(self.walk.table().duration).max(0.0);
        while self.elapsed >= KNOT {
            self.elapsed -= KNOT;
            self.plan_knot();
        }
        self.half_step().index != before
    }

    /// Where the walk is now.
    pub fn half_step(&self) -> HalfStep {
        let place = self.place();
        let newest = self.walk.half_step();
        let index = place.floor();
        let behind = newest.index.saturating_sub(index as u64);
        HalfStep {
            index: index as u64,
            support: if behind.is_multiple_of(2) { newest.support } else { newest.support.other() },
            progress: place - index,
        }
    }

    /// The speed factor of now.
    pub fn speed(&self) -> f64 {
        let [_, from, to, _] = &self.knots;
        from.speed + (to.speed - from.speed) * self.elapsed / KNOT
    }

    /// Share of the weight that the bearing foot is to carry now.
    pub fn weight_on_bearing(&self) -> f64 {
        let [_, from, to, _] = &self.knots;
        from.weight + (to.weight - from.weight) * self.elapsed / KNOT
    }

    /// What is asked now, in physical joints.
    pub fn physical_motion(&self) -> Motion {
        let [before, from, to, after] = &self.knots;
        let state = |before: &Knot, here: &Knot, after: &Knot| Motion {
            angles: here.angles,
            rates: (after.angles - before.angles) * (0.5 / KNOT),
            accelerations: (after.angles + before.angles - here.angles * 2.0) * (1.0 / (KNOT * KNOT)),
        };
        gait::interpolate(&state(before, from, to), &state(from, to, after), self.elapsed / KNOT, KNOT)
    }

    /// What is asked now, in support coordinates.
    pub fn motion(&self) -> Motion {
        match self.half_step().support {
            Side::Right => self.physical_motion(),
            Side::Left => self.physical_motion().mirrored(self.walk.mirror()),
        }
    }

    /// Whether a leg was too short at the newest knot, so that the posture before was kept.
    pub fn is_out_of_reach(&self) -> bool {
        self.unreachable
    }

    /// The walk that is asked for, at the newest knot.
    pub fn walk(&self) -> &Walk {
        &self.walk
    }

    fn place(&self) -> f64 {
        let [_, from, to, _] = &self.knots;
        (from.place + (to.place - from.place) * self.elapsed / KNOT).max(0.0)
    }

    /// Plans and realises one more knot.
    fn plan_knot(&mut self) {
        // where the centre of mass goes, seen from the last knot
        let wanted = self.outlook.weighed(&self.cart);
        self.com = [0, 1].map(|axis| self.cart.advance(&self.com[axis], wanted[axis]));
        self.outlook.advance(&self.tree, &self.mechanism);

        // where the feet go
        if self.gate.advance(&mut self.walk) {
            self.swap();
        }

        if self.gate.is_standing() {
            self.hips.crouch(&self.feet.standing, self.gate.shifted());
        }

        // the legs that do both
        let half_step = self.walk.half_step();
        let asked = self.walk.motion();
        let kinematics = Kinematics::standing(&self.tree, &asked.angles);
        let nominal = self.walk.table().at(half_step.progress);
        let swinging = SolePose::swinging(&self.mechanism, &kinematics);
        let pelvis_ahead = kinematics.rotation[PELVIS].column(0).into_owned();
        let wanted = Wanted {
            com: self.feet.footprint.point_to_support(Vector2::new(self.com[0].x, self.com[1].x)),
            hip_height: Kinematics::standing(&self.tree, &nominal.angles).origin[PELVIS].z
                - self.hips.lowered(half_step.progress),
            pelvis_yaw: pelvis_ahead.y.atan2(pelvis_ahead.x),
            swinging: self.swing.at(half_step.progress, &swinging),
        };
        let reached = self.body.reach(&self.tree, &self.mechanism, &nominal.angles, &wanted);
        self.unreachable = reached.is_err();
        let angles = reached.map_or(self.knots[3].angles, |angles| match half_step.support {
            Side::Right => angles,
            Side::Left => self.walk.mirror().apply(&angles),
        });
        let weight = self.gate.weight_on_bearing();
        let speed = if self.gate.is_standing() { 0.0 } else { self.walk.speed().state().value };
        let knot = Knot { angles, place: half_step.index as f64 + half_step.progress, speed, weight };
        self.knots.rotate_left(1);
        self.knots[3] = knot;
    }

    /// A new half-step begins at the newest knot.
    fn swap(&mut self) {
        let (tree, mechanism, walk) = (&self.tree, &self.mechanism, &self.walk);
        self.feet = self.feet.next(|standing| {
            self.swing = SwingPath::new(standing, |progress| swinging_sole(tree, mechanism, walk, progress));
            self.swing.landing
        });
        self.hips.begin_half_step(&self.swing.landing);
        self.body.swap(&self.tree, self.walk.mirror());
    }
}

const PELVIS: model::Joint = dynamics::Leg(Side::Right).end();

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
