//! The doctor finds nothing wrong with a robot that walks, and names the key of a planted fault. All robots and all
//! faults: `survey doctor`.

use halfstep_tests::planted_faults::{PLANTED, examined, first_wrong};

#[test]
fn the_papers_robot_is_healthy() {
    assert_eq!(first_wrong(&examined("config")), None);
}

/// One that is computed, one that fells the robot in its stand, one that only pushes show, and one of admission.
#[test]
fn planted_faults_are_named_first() {
    let names = ["sensors 16 ms late", "a slope of 8°", "no feedback", "speed changed within 0.05 s"];
    for name in names {
        let fault = PLANTED.iter().find(|fault| fault.name == name).expect("there is one of this name");
        let found = fault.found();
        assert!(fault.is_named_by(found.as_ref()), "{name}: {found:#?}");
    }
}
