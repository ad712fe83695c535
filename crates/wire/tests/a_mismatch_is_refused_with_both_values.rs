//! A mismatch is refused with both values: of the protocol's version, of the rate, and of the mechanism's fingerprint.

mod common;

use common::{MECHANISM, measurement, own_instance, setpoint};
use wire::{ConnectError, ControllerPorts, ObserverPorts, OperatorPorts, PROTOCOL, PlantPorts};

#[test]
fn another_mechanism_is_refused_in_either_start_order() {
    let other = 0xfeed;
    let text = |error: ConnectError| error.to_string();
    let refusal = |instance: &wire::Instance, theirs: &str, ours: &str| {
        format!(
            "service `halfstep/{}/setpoint` has mechanism {theirs}, this process has mechanism {ours}; \
             start both sides with the same mechanism file",
            instance.name()
        )
    };
    let (instance, _leftovers) = own_instance();
    let _plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    assert_eq!(
        ControllerPorts::connect(&instance, other).map_err(text).unwrap_err(),
        refusal(&instance, "0x0123456789abcdef", "0x000000000000feed")
    );

    let (instance, _leftovers) = own_instance();
    let _controller = ControllerPorts::connect(&instance, other).unwrap();
    assert_eq!(
        PlantPorts::connect(&instance, MECHANISM).map_err(text).unwrap_err(),
        refusal(&instance, "0x000000000000feed", "0x0123456789abcdef")
    );
    assert!(OperatorPorts::connect(&instance).is_ok(), "operators need not know the mechanism");
}

#[test]
fn another_rate_is_refused_and_observers_can_read_it() {
    let (instance, _leftovers) = own_instance();
    let faster = instance.clone().with_rate_hz(2000);
    let _controller = ControllerPorts::connect(&faster, MECHANISM).unwrap();
    assert_eq!(
        PlantPorts::connect(&instance, MECHANISM).unwrap_err().to_string(),
        format!(
            "service `halfstep/{}/setpoint` has rate_hz 2000, this process has rate_hz 1000; \
             start both sides with the same realtime.toml",
            instance.name()
        )
    );
    assert!(OperatorPorts::connect(&instance).is_ok(), "operators need not know the rate");
    assert_eq!(ObserverPorts::connect(&instance).unwrap().reports.rate_hz(), 2000);
}

#[test]
fn another_clock_is_refused_in_either_start_order() {
    let (instance, _leftovers) = own_instance();
    let lockstep = instance.clone().with_lockstep(true);
    let refusal = |theirs: &str, ours: &str| {
        format!(
            "service `halfstep/{}/setpoint` has clock {theirs}, this process has clock {ours}; \
             start both sides with --lockstep, or both without it",
            instance.name()
        )
    };
    let controller = ControllerPorts::connect(&lockstep, MECHANISM).unwrap();
    let text = PlantPorts::connect(&instance, MECHANISM).unwrap_err().to_string();
    assert_eq!(text, refusal("lockstep", "realtime"));
    drop(controller);
    let _plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    let text = ControllerPorts::connect(&lockstep, MECHANISM).unwrap_err().to_string();
    assert_eq!(text, refusal("realtime", "lockstep"));
}

#[test]
fn another_start_posture_is_refused_until_the_robot_moves() {
    let (instance, _leftovers) = own_instance();
    let stand = instance.clone().with_stand(true);
    let mut controller = ControllerPorts::connect(&stand, MECHANISM).unwrap();
    let text = PlantPorts::connect(&instance, MECHANISM).unwrap_err().to_string();
    let expected = format!(
        "service `halfstep/{}/setpoint` has start stand, this process has start stride; \
         start both sides with --from-stand, or both without it",
        instance.name()
    );
    assert_eq!(text, expected);
    let _plant = PlantPorts::connect(&stand, MECHANISM).unwrap();

    // A controller that takes over a robot that has moved finds it in any posture.
    controller.setpoints.write(&setpoint(0));
    drop(controller);
    assert!(ControllerPorts::connect(&instance, MECHANISM).is_ok());
}

#[test]
fn another_protocol_version_is_refused_for_every_process() {
    let (instance, _leftovers) = own_instance();
    let newer = instance.clone().with_protocol(PROTOCOL + 1);
    let _controller = ControllerPorts::connect(&instance, MECHANISM).unwrap();
    let refusals = [
        ("setpoint", PlantPorts::connect(&newer, MECHANISM).unwrap_err()),
        ("setpoint", ControllerPorts::connect(&newer, MECHANISM).unwrap_err()),
        ("request", OperatorPorts::connect(&newer).unwrap_err()),
        ("report", ObserverPorts::connect(&newer).unwrap_err()),
    ];
    for (service, error) in refusals {
        assert_eq!(
            error.to_string(),
            format!(
                "service `halfstep/{}/{service}` has protocol {}, this process has protocol {}; \
                 run the same version of halfstep on both sides",
                instance.name(),
                PROTOCOL,
                PROTOCOL + 1
            )
        );
    }
}

#[test]
fn a_new_version_may_start_once_all_old_processes_have_disconnected() {
    let (instance, _leftovers) = own_instance();
    let mut plant = PlantPorts::connect(&instance, MECHANISM).unwrap();
    plant.measurements.write(&measurement(1));
    drop(plant);
    let newer = instance.clone().with_protocol(PROTOCOL + 1);
    let mut controller = ControllerPorts::connect(&newer, 0xfeed).unwrap();
    assert_eq!(controller.measurements.latest(), None);
}
