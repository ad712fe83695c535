//! The functions that a page calls. Texts go through the module's memory: the page asks for room for a text, writes it
//! there, and calls a function that reads it; what the page is to be told then is the output, one JSON text per line.

use std::cell::RefCell;

use scene::FromPage;

use crate::{Beginning, PageWalk, PaperInstrument, PaperNews, WalkNews};

/// The walk of the page or its instrument, and the texts from and to it.
#[derive(Debug, Default)]
struct PageState {
    walk: Option<PageWalk>,
    paper: Option<PaperInstrument>,
    input: Vec<u8>,
    output: String,
}

thread_local! {
    static STATE: RefCell<PageState> = RefCell::default();
}

/// Makes room for a text of so many bytes, and returns where the page is to write it.
#[unsafe(no_mangle)]
pub extern "C" fn halfstep_input(length: usize) -> *mut u8 {
    STATE.with_borrow_mut(|state| {
        state.input = vec![0; length];
        state.input.as_mut_ptr()
    })
}

/// Where the output is.
#[unsafe(no_mangle)]
pub extern "C" fn halfstep_output() -> *const u8 {
    STATE.with_borrow(|state| state.output.as_ptr())
}

/// How many bytes the output has.
#[unsafe(no_mangle)]
pub extern "C" fn halfstep_output_length() -> usize {
    STATE.with_borrow(|state| state.output.len())
}

/// Begins the walk that the input, a [`Beginning`], describes. If there is none of it, the last one goes on.
#[unsafe(no_mangle)]
pub extern "C" fn halfstep_begin() {
    STATE.with_borrow_mut(|state| {
        let beginning = serde_json::from_slice::<Beginning>(&state.input).map_err(|error| error.to_string());
        match beginning.and_then(|beginning| PageWalk::begin(&beginning)) {
            Ok(walk) => {
                state.walk = Some(walk);
                state.give_output();
            }
            Err(problem) => state.output = WalkNews::Problem(&problem).text(),
        }
    });
}

/// Takes the input, a message as `halfstep view` takes it from its page. One that is none is ignored.
#[unsafe(no_mangle)]
pub extern "C" fn halfstep_hear() {
    STATE.with_borrow_mut(|state| {
        if let (Some(walk), Ok(message)) = (&mut state.walk, serde_json::from_slice::<FromPage>(&state.input)) {
            walk.hear(&message);
        }
        state.give_output();
    });
}

/// Walks on by so many periods.
#[unsafe(no_mangle)]
pub extern "C" fn halfstep_walk(ticks: u32) {
    STATE.with_borrow_mut(|state| {
        if let Some(walk) = &mut state.walk {
            walk.walk_on(ticks);
        }
        state.give_output();
    });
}

/// Begins the paper as an instrument; the output says what can be turned.
#[unsafe(no_mangle)]
pub extern "C" fn halfstep_paper() {
    STATE.with_borrow_mut(|state| {
        let news = match PaperInstrument::new() {
            Ok(paper) => state.paper.insert(paper).dials(),
            Err(problem) => PaperNews::Problem(problem),
        };
        state.output = news.text();
    });
}

/// Answers the input, a [`Question`](paper::Question).
#[unsafe(no_mangle)]
pub extern "C" fn halfstep_ask() {
    STATE.with_borrow_mut(|state| {
        let news = state.paper.as_mut().map(|paper| paper.answer(&state.input));
        state.output = news.map(|news| news.text()).unwrap_or_default();
    });
}

impl PageState {
    fn give_output(&mut self) {
        self.output = self.walk.as_mut().map(PageWalk::take_news).unwrap_or_default().join("\n");
    }
}
