//! Goal: the slower the walk, the nearer the ZMP comes to the projection of the centre of mass (the paper's figures 23
//! to 27), and hardly moving it is there.
//!
//! Method: the mean and the greatest distance between the two paths for ever smaller `c`, by Newton–Euler.

use halfstep_tests::paper::{reading, robot, scenario};
use paper::{Figure, Scenario, reproduce};

/// Mean and greatest distance of the ZMP from the centre of mass's projection (m).
fn distances(figure: &Figure) -> [f64; 2] {
    let pairs = figure.zmp.iter().flatten().zip(figure.com.iter().flatten());
    let distances: Vec<f64> = pairs.map(|(zmp, com)| (zmp - com).norm()).collect();
    [distances.iter().sum::<f64>() / distances.len() as f64, distances.iter().copied().fold(0.0, f64::max)]
}

#[test]
fn zmp_approaches_the_centre_of_mass_as_the_walk_slows() {
    let robot = robot();
    let mut walks: Vec<Scenario> = (23..=27).map(scenario).collect();
    // Slower than the paper went, down to hardly moving.
    for speed in [0.4, 0.2, 0.1] {
        let mut slower = walks[0].clone();
        slower.request.speed = speed;
        walks.push(slower);
    }
    let mut before = [f64::INFINITY; 2];
    for walk in &walks {
        let now = distances(&reproduce(&robot, reading(), walk).unwrap());
        let closer = now.iter().zip(before).all(|(now, before)| *now < before);
        assert!(closer, "speed {}: {now:?} m apart, faster {before:?} m", walk.request.speed);
        before = now;
    }
    assert!(before[1] < 2.5e-3, "hardly moving, still {} m apart", before[1]);
}
