//! A mismatch is refused with both values: of the protocol's version, of the rate, and of the mechanism's fingerprint.

mod common;

use common::{MECHANISM, measurement, own_instance};
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
