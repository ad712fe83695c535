//! A request is answered with its id, expires, and is cancelled by its sender: by dropping it, by leaving, or by being
//! killed. None of these is carried out later.

use std::time::Duration;

use halfstep_tests::command_line::CommandLine;
use interface::{GaitChange, Intent, Mode, Reason, Reply, Request, Source, Verdict};
use record::{Recording, RunEvent};
use wire::{OperatorPorts, PendingReply};

const SAFETY: Duration = Duration::from_secs(20);

fn walk() -> Request {
    Request { intent: Some(Intent::Walk), ..Request::new(Source::Program) }
}

fn reply(operator: &OperatorPorts, pending: &PendingReply) -> Reply {
    operator.requests.wait(pending, SAFETY).unwrap().checked().unwrap()
}

#[test]
fn every_reply_carries_the_id_of_its_request() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let controller = command_line.start_here("controller --lockstep --from-stand --out log");
    command_line.wait_for_controller();
    let operator = OperatorPorts::connect(command_line.wire_instance()).unwrap();
    let turn = |turn| GaitChange { turn: Some(turn), ..GaitChange::NONE };
    let requests = [
        (Request { id: 11, expires_ns: Some(1), ..walk() }, Verdict::Refused, Reason::Expired),
        (Request { id: 12, not_before: 20, ..walk() }, Verdict::Accepted, Reason::None),
        (
            Request { id: 13, gait: turn(f64::NAN), ..Request::new(Source::Program) },
            Verdict::Refused,
            Reason::NotFinite,
        ),
        (Request { id: 14, ..Request::new(Source::Program) }, Verdict::Refused, Reason::Empty),
        (Request { id: 15, gait: turn(9.0), not_before: 30, ..walk() }, Verdict::Limited, Reason::TurnLimit),
        // It has expired, but a stop does not.
        (
            Request { id: 16, intent: Some(Intent::Stop), not_before: 900, expires_ns: Some(1), ..walk() },
            Verdict::Accepted,
            Reason::None,
        ),
    ];
    let sent = requests.map(|(request, ..)| operator.requests.send(&(&request).into()).unwrap());
    let plant = command_line.start_here("plant --lockstep --from-stand --for 3s");
    for ((request, verdict, reason), pending) in requests.iter().zip(&sent) {
        let reply = reply(&operator, pending);
        assert_eq!((reply.id, reply.verdict, reply.reason), (request.id, *verdict, *reason));
    }
    plant.finish();
    controller.end();

    let mut ids = [Vec::new(), Vec::new()];
    let mut recording = Recording::open(&command_line.folder().join("log/controller.mcap")).unwrap();
    while let Some(stamped) = recording.next_event().unwrap() {
        match stamped.event {
            RunEvent::Request(request) => ids[0].push(request.id),
            RunEvent::Reply(reply) => ids[1].push(reply.id),
            _ => {}
        }
    }
    ids.iter_mut().for_each(|ids| ids.sort_unstable());
    assert_eq!(ids, [vec![11, 12, 13, 14, 15, 16], vec![11, 12, 13, 14, 15, 16]], "so the recording says, too");
}

#[test]
fn a_request_that_was_told_to_have_failed_is_not_carried_out_later() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    // Without a plant nothing ticks, so that nothing is answered.
    let controller = command_line.start_here("controller --from-stand");
    command_line.wait_for_controller();
    let failed = command_line.start_here("send walk").finish();
    assert_eq!((failed.code, &*failed.stdout), (Some(1), ""), "{}", failed.stderr);
    assert!(failed.stderr.starts_with("the controller did not answer within 2.5 s"), "{}", failed.stderr);
    let killed = command_line.start_here("send walk");
    std::thread::sleep(Duration::from_millis(500));
    killed.kill();
    let operator = OperatorPorts::connect(command_line.wire_instance()).unwrap();
    let cancelled = operator.requests.send(&(&walk()).into()).unwrap();
    drop(cancelled);
    // What the killed one sent expires.
    std::thread::sleep(Duration::from_millis(2100));
    let _plant = command_line.start_here("plant --from-stand");
    let stop = Request { intent: Some(Intent::Stop), not_before: 500, ..walk() };
    let reply = reply(&operator, &operator.requests.send(&(&stop).into()).unwrap());
    assert_eq!((reply.mode, reply.effect_half_step), (Some(Mode::Standing), 0), "it never set off");
    let ended = controller.end();
    assert!(ended.stdout.contains(", 0 half-steps"), "{}", ended.stdout);
}
