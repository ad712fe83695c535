//! Controller and plant in one thread, compiled to WebAssembly, for a page that needs no server.
//!
//! A [`PageWalk`] is a [`LockstepWalk`](lockstep::LockstepWalk) that a page has begun: it takes the page's messages,
//! which are those of `halfstep view`, and gives it frames. Its [`Session`] says by which files `halfstep walk` repeats
//! it. A [`PaperInstrument`] answers with other numbers of the paper's body what becomes of its verdicts. The functions
//! that the page calls are in `page_functions`; how the page is built is in `tools/web`.

mod page_functions;
mod page_message;
mod page_walk;
mod paper_instrument;
mod session;

pub use page_functions::{
    halfstep_ask, halfstep_begin, halfstep_hear, halfstep_input, halfstep_output, halfstep_output_length,
    halfstep_paper, halfstep_walk,
};
pub use page_message::{Beginning, ChosenRobot, NamedFile, WalkNews};
pub use page_walk::PageWalk;
pub use paper_instrument::{PaperInstrument, PaperNews};
pub use session::Session;
