//! However many requests other operators send, of whatever kind, a stop is answered and walked; and requests of an
//! operator that has gone are not carried out.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use halfstep_tests::command_line::{CommandLine, Running};
use interface::{GaitChange, Intent, Lifetime, Reason, Request, Source, Verdict};
use wire::{Instance, OperatorPorts, PendingReply, RequestMessage};

/// Nothing here takes so long.
const SAFETY: Duration = Duration::from_secs(20);
/// A tick that no run reaches.
const NEVER: u64 = 1 << 60;

fn request(gait: GaitChange, intent: Option<Intent>) -> Request {
    Request { gait, intent, ..Request::new(Source::Program) }
}

fn speed(speed: f64) -> GaitChange {
    GaitChange { speed: Some(speed), ..GaitChange::NONE }
}

/// The kinds of floods, with the n-th message of each.
type Flood = (&'static str, fn(u64) -> RequestMessage);
const FLOODS: &[Flood] = &[
    ("empty requests", |_| (&Request::new(Source::Program)).into()),
    ("heartbeats", |_| (&Request { lifetime: Lifetime::Streamed, ..Request::new(Source::Program) }).into()),
    ("requests that are not finite", |_| RequestMessage {
        speed: f64::NAN,
        ..RequestMessage::from(&request(speed(1.0), None))
    }),
    ("changes of speed", |n| (&request(speed(0.9 + 0.01 * (n % 20) as f64), None)).into()),
    ("walks", |_| (&request(GaitChange::NONE, Some(Intent::Walk))).into()),
    ("requests for later", |n| (&Request { not_before: NEVER + n, ..request(speed(1.1), None) }).into()),
];

/// Sends as many requests as the service takes, until `ends`.
fn flood(instance: &Instance, message: fn(u64) -> RequestMessage, ends: &AtomicBool) {
    let operator = OperatorPorts::connect(instance).unwrap();
    let mut unanswered: Vec<PendingReply> = Vec::new();
    let mut n = 0;
    while !ends.load(Ordering::Relaxed) {
        n += 1;
        match operator.requests.send(&message(n)) {
            Ok(pending) => unanswered.push(pending),
            Err(_) => unanswered.retain(|pending| matches!(pending.poll(), Ok(None))),
        }
    }
}

fn pair(command_line: &CommandLine) -> [Running; 2] {
    let pair = ["controller", "plant"].map(|role| command_line.start_here(role));
    command_line.wait_for_controller();
    pair
}

#[test]
fn a_stop_is_answered_and_walked_during_every_kind_of_flood() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _pair = pair(&command_line);
    let operator = OperatorPorts::connect(command_line.wire_instance()).unwrap();
    let ask = |intent| {
        let request = Request { intent: Some(intent), ..Request::new(Source::Console) };
        operator.requests.ask(&(&request).into(), SAFETY).unwrap().checked().unwrap()
    };
    for (name, message) in FLOODS {
        assert_ne!(ask(Intent::Walk).verdict, Verdict::Refused, "before the flood of {name}");
        let ends = AtomicBool::new(false);
        std::thread::scope(|scope| {
            for _ in 0..3 {
                scope.spawn(|| flood(command_line.wire_instance(), *message, &ends));
            }
            std::thread::sleep(Duration::from_millis(300));
            for intent in [Intent::Stop, Intent::Hold, Intent::Stop] {
                let reply = ask(intent);
                assert_eq!((reply.verdict, reply.intent), (Verdict::Accepted, Some(intent)), "in a flood of {name}");
            }
            ends.store(true, Ordering::Relaxed);
        });
    }
}

#[test]
fn every_request_is_answered_however_many_arrive_at_once() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _pair = pair(&command_line);
    let instance = command_line.wire_instance();
    let operators: Vec<OperatorPorts> = (0..6).map(|_| OperatorPorts::connect(instance).unwrap()).collect();
    let invalid = RequestMessage { speed: f64::NAN, ..RequestMessage::from(&request(speed(1.0), None)) };
    let sent: Vec<Vec<PendingReply>> = operators
        .iter()
        .map(|operator| (0..wire::MAX_UNANSWERED).map(|_| operator.requests.send(&invalid).unwrap()).collect())
        .collect();
    for (operator, pending) in operators.iter().zip(&sent) {
        for (number, pending) in pending.iter().enumerate() {
            let reply = operator.requests.wait(pending, SAFETY).unwrap_or_else(|error| panic!("{number}: {error}"));
            assert_eq!(reply.checked().unwrap().reason, Reason::NotFinite);
        }
    }
}

#[test]
fn requests_of_an_operator_that_has_gone_are_not_carried_out() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    // Without a plant nothing ticks, so that nothing is answered.
    let controller = command_line.start_here("controller --from-stand");
    command_line.wait_for_controller();
    let instance = command_line.wire_instance();
    let walk = Request { intent: Some(Intent::Walk), ..Request::new(Source::Console) };
    let operator = OperatorPorts::connect(instance).unwrap();
    drop(operator.requests.send(&(&walk).into()).unwrap());
    drop(operator);
    std::thread::sleep(Duration::from_millis(500));

    let plant = command_line.start_here("plant --from-stand --for 3s").finish();
    assert_eq!(plant.code, Some(0), "{}", plant.stderr);
    let ended = controller.end();
    assert!(ended.stdout.contains(" 0 half-steps"), "{}", ended.stdout);
}
