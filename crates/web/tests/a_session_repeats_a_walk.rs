//! Goal: what a page did to its robot, written down as commands and disturbances, repeats the walk bit for bit.

use config::Config;
use dialogue::script::Reader;
use interface::{Intent, Request, Source};
use lockstep::{LockstepOptions, LockstepWalk, WalkableRobot};
use plant::Disturbances;
use scene::FromPage;
use serde_json::{Value, json};
use web::{Beginning, PageWalk};

/// What the page says when so many periods have been walked.
const SAID: [(u64, &str); 6] = [
    (1500, r#"{"command": {"turn_deg": 12}}"#),
    (1510, r#"{"command": {"turn_deg": 8, "speed": 1.1}}"#),
    (4000, r#"{"push": {"joint": 15, "impulse": [3, -4, 0], "lasts_s": 0.1}}"#),
    (6003, r#""stop""#),
    (9000, r#"{"command": {"vx": 0.2}}"#),
    (10700, r#"{"drive": false}"#),
];
const TICKS: u64 = 12_000;

fn begin(robot: &str, seed: u64) -> PageWalk {
    let beginning: Beginning =
        serde_json::from_value(json!({ "robot": { "in_the_box": robot }, "seed": seed })).expect("a beginning");
    PageWalk::begin(&beginning).expect("it can walk")
}

/// What the page has been told of a kind since the last time.
fn told(walk: &mut PageWalk, kind: &str) -> Vec<Value> {
    let news = walk.take_news().into_iter().map(|text| serde_json::from_str::<Value>(&text).expect("JSON"));
    news.filter_map(|mut message| message.as_object_mut()?.remove(kind)).collect()
}

#[test]
fn a_session_repeats_a_walk() {
    for (robot, seed) in [("paper", 3), ("g1", 0)] {
        let mut page = begin(robot, seed);
        let mut said = SAID.iter().peekable();
        while page.walk().tick() < TICKS {
            if let Some((_, text)) = said.next_if(|(tick, _)| *tick == page.walk().tick()) {
                page.hear(&serde_json::from_str::<FromPage>(text).expect("a message"));
            }
            let next = said.peek().map_or(TICKS, |(tick, _)| *tick);
            page.walk_on(u32::try_from(next - page.walk().tick()).expect("not many"));
        }
        let walked = told(&mut page, "walked").pop().expect("it has walked");
        let text = |key: &str| walked[key].as_str().expect("a text").to_owned();

        let walk = Request { intent: Some(Intent::Walk), ..Request::new(Source::Script) };
        let script = Reader::read_all("commands.jsonl", text("commands").as_bytes()).expect("a script");
        assert_eq!(script.len(), 4, "{}", text("commands"));
        let options = LockstepOptions { seed, ..LockstepOptions::default() };
        let rate = options.rate;
        let script = script.iter().map(|timed| Request { not_before: timed.tick(rate), ..timed.request });
        let disturbances = Disturbances::from_toml(&text("disturbances"), "disturbances.toml").expect("a push");
        assert_eq!(disturbances.pushes.len(), 1);
        let configured = WalkableRobot::in_the_box(robot).expect("it is in the box");
        let mut again =
            LockstepWalk::new(&configured, &options, [walk].into_iter().chain(script), disturbances).unwrap();
        let calm = LockstepWalk::new(&configured, &options, [walk], Disturbances::default());
        let mut calm = calm.expect("it can walk");
        for _ in 0..TICKS {
            again.step(&mut |_| ());
            calm.step(&mut |_| ());
        }
        assert_eq!(again.setpoints().to_string(), text("hash"), "{robot}");
        assert_ne!(again.setpoints(), calm.setpoints(), "what is said matters");
    }
}

#[test]
fn a_robot_that_is_not_in_the_box_and_a_command_that_is_none_are_told() {
    let unknown = json!({ "robot": { "in_the_box": "g2" } });
    let problem = PageWalk::begin(&serde_json::from_value(unknown).expect("a beginning")).expect_err("there is none");
    assert!(problem.contains("must be one of paper, g1"), "{problem}");
    let urdf = json!({ "robot": { "urdf": { "urdf": { "name": "box.urdf", "text": "<robot/>" }, "map": null } } });
    let problem = PageWalk::begin(&serde_json::from_value(urdf).expect("a beginning")).expect_err("it has no legs");
    assert!(problem.starts_with("box.urdf"), "{problem}");

    let mut page = begin("t1", 0);
    page.hear(&FromPage::Command(json!({ "trun_deg": 5 })));
    let answers = told(&mut page, "answer");
    assert_eq!(answers[0]["verdict"], "refused");
    assert!(answers[0]["text"].as_str().is_some_and(|text| text.contains("unknown field `trun_deg`")), "{answers:?}");
}
