//! The server of the page: HTTP and WebSocket on one address.

use std::net::{SocketAddr, TcpListener};
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::extract::{RawQuery, State, WebSocketUpgrade};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use model::Mechanism;
use wire::Instance;

use crate::access::Access;
use crate::live_feed::LiveFeed;
use crate::live_pages::LivePages;
use crate::pusher::Pusher;
use crate::socket::{serve_live, serve_recorded};
use crate::teleoperation::Teleoperation;
use crate::{RecordedRun, ViewError};

/// Longest message of a page (bytes): longer than any command.
const MESSAGE_MAX: usize = 64 * 1024;
/// Time between two looks whether to end.
const END_POLL: Duration = Duration::from_millis(50);
/// What the page may load: its own files and its own socket.
const POLICY: &str =
    "default-src 'self'; img-src 'self' data:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

/// The files of the page: path, type and content. `tools/view` makes them.
const FILES: [(&str, &str, &[u8]); 3] = [
    ("/", "text/html; charset=utf-8", include_bytes!("../page/index.html")),
    ("/view.js", "text/javascript; charset=utf-8", include_bytes!("../page/view.js")),
    ("/view.css", "text/css; charset=utf-8", include_bytes!("../page/view.css")),
];

/// What a page shows.
#[derive(Debug)]
pub enum Shown {
    /// A robot that is running, as soon as it is. The page can drive it.
    Live(Box<RunningRobot>),
    /// Recorded runs, over each other.
    Recorded(Vec<RecordedRun>),
}

/// Which robot a page shows and drives.
#[derive(Debug)]
pub struct RunningRobot {
    /// The robot's instance.
    pub instance: Instance,
    /// The robots that it may be: the fingerprint tells which one.
    pub robots: Vec<Mechanism>,
    /// How long a page that drives may be silent before the controller stops the robot; `None` is the controller's own
    /// limit.
    pub age_limit: Option<Duration>,
}

/// A server that has its address, and is not serving yet.
#[derive(Debug)]
pub struct ViewServer {
    listener: TcpListener,
    address: SocketAddr,
    access: Access,
}

/// What all sockets share.
pub(crate) struct Shared {
    access: Access,
    pub(crate) shown: ShownTexts,
}

/// What a page shows, ready to be sent.
pub(crate) enum ShownTexts {
    Live(LivePages),
    Recorded(Vec<RecordedRun>),
}

impl ViewServer {
    /// Takes an address; with port 0 any that is free.
    ///
    /// # Errors
    /// The address is taken, or is none of this computer.
    pub fn bind(address: SocketAddr) -> Result<Self, ViewError> {
        let failed = |cause| ViewError::Listen { address, cause };
        let listener = TcpListener::bind(address).map_err(failed)?;
        listener.set_nonblocking(true).map_err(failed)?;
        let address = listener.local_addr().map_err(failed)?;
        let no_token = |cause: rustix::io::Errno| ViewError::System { what: "make a token", cause: cause.into() };
        Ok(Self { listener, address, access: Access::new(address).map_err(no_token)? })
    }

    /// The address of the page, with the token.
    pub fn url(&self) -> String {
        format!("http://{}/#token={}", self.address, self.access.token)
    }

    /// Whether only this computer reaches it.
    pub fn is_local(&self) -> bool {
        self.address.ip().is_loopback()
    }

    /// Serves pages until `is_over`.
    ///
    /// # Errors
    /// The operating system refuses a thread or the socket.
    pub fn serve(self, shown: Shown, is_over: impl Fn() -> bool) -> Result<(), ViewError> {
        let failed = |what| move |cause| ViewError::System { what, cause };
        let texts = match shown {
            Shown::Recorded(runs) => ShownTexts::Recorded(runs),
            Shown::Live(robot) => {
                let RunningRobot { instance, robots, age_limit } = *robot;
                let (feed, texts) = LiveFeed::new(instance.clone(), robots);
                let (pages, orders, pushes) = LivePages::new(texts);
                let pusher = Pusher::new(instance.clone(), pages.answers.clone());
                let teleoperation = Teleoperation::new(instance, age_limit, pages.answers.clone());
                let thread = |name: &str| std::thread::Builder::new().name(name.to_owned());
                thread("live-feed").spawn(move || feed.run()).map_err(failed("start a thread"))?;
                thread("pushes").spawn(move || pusher.run(&pushes)).map_err(failed("start a thread"))?;
                thread("teleoperation").spawn(move || teleoperation.run(&orders)).map_err(failed("start a thread"))?;
                ShownTexts::Live(pages)
            }
        };
        let shared = Arc::new(Shared { access: self.access, shown: texts });
        let mut router = Router::new().route("/socket", get(open_socket));
        for (path, kind, content) in FILES {
            router = router.route(path, get(move |state, headers| page_file(state, headers, kind, content)));
        }
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
        runtime.map_err(failed("start the server"))?.block_on(async {
            let listener = tokio::net::TcpListener::from_std(self.listener).map_err(failed("listen"))?;
            let over = async {
                while !is_over() {
                    tokio::time::sleep(END_POLL).await;
                }
            };
            let serving = async { axum::serve(listener, router.with_state(shared)).await };
            tokio::select! {
                served = serving => served.map_err(failed("serve")),
                () = over => Ok(()),
            }
        })
    }
}

async fn page_file(
    State(shared): State<Arc<Shared>>,
    headers: HeaderMap,
    kind: &'static str,
    content: &'static [u8],
) -> Response {
    if !shared.access.is_called_by_name(&headers) {
        return StatusCode::FORBIDDEN.into_response();
    }
    let headers = [
        (header::CONTENT_TYPE, kind),
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "no-store"),
    ];
    (headers, content).into_response()
}

async fn open_socket(
    State(shared): State<Arc<Shared>>,
    RawQuery(query): RawQuery,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    let token = query.as_deref().and_then(|query| query.strip_prefix("token=")).unwrap_or_default();
    if !shared.access.permits(&headers, token) {
        return StatusCode::FORBIDDEN.into_response();
    }
    upgrade.max_message_size(MESSAGE_MAX).on_upgrade(move |socket| async move {
        match &shared.shown {
            ShownTexts::Live(pages) => serve_live(socket, pages).await,
            ShownTexts::Recorded(runs) => serve_recorded(socket, runs).await,
        }
    })
}
