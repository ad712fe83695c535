//! A `halfstep view` process with one page that takes all it is sent, as a browser does.

use std::io::{BufRead, BufReader};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use rustix::process::{Pid, Signal, kill_process};
use serde::Deserialize;
use tungstenite::client::IntoClientRequest;
use tungstenite::http::HeaderValue;
use tungstenite::{Message, WebSocket, client};

use crate::BenchError;

/// A viewer with its page. Dropping it ends both.
#[derive(Debug)]
pub(crate) struct PageViewer {
    process: Child,
    page: Option<JoinHandle<()>>,
    has_shown: Arc<AtomicBool>,
}

/// What `halfstep view --json` prints.
#[derive(Deserialize)]
struct ServedPage {
    url: String,
}

impl PageViewer {
    /// Starts a viewer by its command, and opens its page. If it is to be stopped, that happens as soon as the page
    /// shows the robot: from then on the viewer takes nothing that it is sent.
    ///
    /// # Errors
    /// The viewer does not start, or serves no page.
    pub(crate) fn open(mut command: Command, is_stopped: bool) -> Result<Self, BenchError> {
        let failed = |cause: &dyn std::fmt::Display| BenchError::new("the viewer", cause);
        let spawned = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
        let mut viewer =
            Self { process: spawned.map_err(|error| failed(&error))?, page: None, has_shown: Arc::default() };
        let mut printed = String::new();
        let stdout = viewer.process.stdout.take().expect("a pipe was asked for");
        BufReader::new(stdout).read_line(&mut printed).map_err(|error| failed(&error))?;
        let ServedPage { url } = serde_json::from_str(&printed).map_err(|error| failed(&error))?;
        let mut socket = connect(&url)?;
        let process = viewer.id();
        let has_shown = Arc::clone(&viewer.has_shown);
        let take_all = move || {
            while let Ok(message) = socket.read() {
                let is_frame = matches!(&message, Message::Text(text) if text.starts_with("{\"frame\""));
                if is_frame && !has_shown.swap(true, Ordering::Relaxed) && is_stopped {
                    // If it has ended, there is nothing to be stopped.
                    let _ = kill_process(process, Signal::STOP);
                }
            }
        };
        let page = std::thread::Builder::new().name("page".to_owned()).spawn(take_all);
        viewer.page = Some(page.map_err(|error| failed(&error))?);
        Ok(viewer)
    }

    /// Whether the page has shown the robot.
    pub(crate) fn has_shown(&self) -> bool {
        self.has_shown.load(Ordering::Relaxed)
    }

    fn id(&self) -> Pid {
        Pid::from_child(&self.process)
    }
}

impl Drop for PageViewer {
    fn drop(&mut self) {
        let process = self.id();
        // It may have ended by itself.
        let _ = kill_process(process, Signal::CONT).and_then(|()| kill_process(process, Signal::TERM));
        let _ = self.process.wait();
        let _ = self.page.take().map(JoinHandle::join);
    }
}

/// Opens the socket of the page at an address like `http://127.0.0.1:8720/#token=0123`.
fn connect(url: &str) -> Result<WebSocket<TcpStream>, BenchError> {
    let failed = |cause: &dyn std::fmt::Display| BenchError::new("the viewer's page", cause);
    let parts = url.strip_prefix("http://").and_then(|rest| rest.split_once("/#"));
    let (host, token) = parts.ok_or_else(|| failed(&url))?;
    let mut request = format!("ws://{host}/socket?{token}").into_client_request().map_err(|error| failed(&error))?;
    let origin = HeaderValue::try_from(format!("http://{host}")).map_err(|error| failed(&error))?;
    request.headers_mut().insert("origin", origin);
    let stream = TcpStream::connect(host).map_err(|error| failed(&error))?;
    Ok(client(request, stream).map_err(|error| failed(&error))?.0)
}
