//! Inverse dynamics of one posture: the joint torques that hold the robot on its right foot, and where its zero-moment
//! point is.
//!
//! ```text
//! cargo run --release --example inverse_dynamics
//! ```

use std::error::Error;

use config::Config;
use dynamics::{NewtonEuler, Tree, zmp};
use model::{Joint, JointVector, Mechanism, Motion};

fn main() -> Result<(), Box<dyn Error>> {
    let mechanism = Mechanism::load("config/mechanism.toml")?;
    let tree = Tree::new(&mechanism);

    // Standing on the right foot, the left knee bent.
    let mut angles = JointVector::ZERO;
    angles[Joint::LeftHipPitch] = -0.4;
    angles[Joint::LeftKnee] = 0.8;
    angles[Joint::LeftAnklePitch] = -0.4;

    let mut inverse = NewtonEuler::default();
    inverse.compute_fixed_base(&tree, &Motion::at_rest(angles));

    for joint in Joint::ALL.into_iter().filter(|joint| joint.is_powered()) {
        println!("{:>2} {:<20} {:8.2} N·m", joint.number(), joint.name(), inverse.torques[joint]);
    }
    let zmp = zmp(&inverse.ground).ok_or("the ground bears no force")?;
    println!("zero-moment point: {:.3} m ahead, {:.3} m to the left of the right ankle", zmp.x, zmp.y);

    // At rest it lies below the centre of mass.
    let com = inverse.kinematics.com(&tree);
    if (zmp - com.xy()).norm() < 1e-9 {
        Ok(())
    } else {
        Err("the zero-moment point of a robot at rest is elsewhere".into())
    }
}

#[test]
fn the_example_finds_the_zmp_below_the_centre_of_mass() {
    std::env::set_current_dir(halfstep_examples::repository()).expect("the repository is there");
    main().expect("it agrees");
}
