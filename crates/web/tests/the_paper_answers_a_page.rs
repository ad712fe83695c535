//! Goal: a page that asks with numbers of its own is told all verdicts and a picture, and in words what it asked wrong.
//!
//! Method: the texts that go through the module's memory.

use serde_json::{Value, json};
use web::PaperInstrument;

fn told(paper: &mut PaperInstrument, question: &Value) -> Value {
    serde_json::from_str(&paper.answer(question.to_string().as_bytes()).text()).expect("JSON")
}

#[test]
fn a_page_is_told_dials_verdicts_and_a_picture() {
    let mut paper = PaperInstrument::new().expect("the paper's robot walks");
    let dials: Value = serde_json::from_str(&paper.dials().text()).expect("JSON");
    let numbers = dials["dials"]["numbers"].as_array().expect("numbers");
    let duration = numbers.iter().find(|number| number["name"] == "duration_s").expect("T");
    assert_eq!((&duration["value"], &duration["plausible"]), (&json!(0.6), &json!([0.5, 0.8])));
    assert_eq!(dials["dials"]["figures"].as_array().map(Vec::len), Some(45));

    let answer = &told(&mut paper, &json!({ "figure": 14 }))["answer"];
    assert_eq!((&answer["agree"], answer["verdicts"].as_array().map(Vec::len)), (&json!(36), Some(38)));
    assert!(answer["drawn"]["svg"].as_str().is_some_and(|svg| svg.starts_with("<svg")), "{answer}");
    let answer = &told(&mut paper, &json!({ "numbers": { "heel_m": 0.081, "duration_s": 0.55 } }))["answer"];
    assert_eq!((&answer["agree"], &answer["drawn"]), (&json!(37), &Value::Null));
}

#[test]
fn a_page_is_told_what_it_asked_wrong() {
    let mut paper = PaperInstrument::new().expect("the paper's robot walks");
    for (question, expected) in [
        (json!({ "numbers": { "toe_m": 3 } }), "toe_m = 3: must lie between"),
        (json!({ "numbers": { "toe_m": "long" } }), "invalid type: string \"long\""),
        (json!({ "number": {} }), "unknown field `number`"),
    ] {
        let problem = told(&mut paper, &question)["problem"].to_string();
        assert!(problem.replace('\\', "").contains(expected), "{problem}");
    }
}
