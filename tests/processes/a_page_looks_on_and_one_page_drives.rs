//! Goal: `halfstep view` shows its robot to its owner only, one page drives and the others look on, and a view that
//! hangs holds up nothing. The browser's side is tested in `tools/view/test`.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use halfstep_tests::command_line::{CommandLine, Running};
use serde_json::{Value, json};

/// Nothing here takes so long.
const SAFETY: Duration = Duration::from_secs(60);

/// A served page: `host:port` and the token.
struct Served {
    view: Running,
    host: String,
    token: String,
}

/// A page's socket.
struct Page(TcpStream);

impl Served {
    fn new(command_line: &CommandLine, words: &str) -> Self {
        let mut view = command_line.start(&format!("view --listen 127.0.0.1:0 --json {words}"));
        let printed: Value = serde_json::from_str(&view.wait_for_line()).expect("JSON");
        let url = printed["url"].as_str().expect("an address").strip_prefix("http://").expect("HTTP");
        let (host, token) = url.split_once("/#token=").expect("a token");
        Self { host: host.to_owned(), token: token.to_owned(), view }
    }

    /// Sends a request with these headers, and gives the status and the connection.
    fn get(&self, path: &str, headers: &str) -> (u16, TcpStream) {
        let mut stream = TcpStream::connect(&self.host).expect("it listens");
        stream.set_read_timeout(Some(SAFETY)).expect("a socket");
        write!(stream, "GET {path} HTTP/1.1\r\n{headers}\r\n").expect("it reads");
        let mut head = Vec::new();
        while !head.ends_with(b"\r\n\r\n") {
            let mut byte = [0];
            stream.read_exact(&mut byte).expect("an answer");
            head.push(byte[0]);
        }
        let head = String::from_utf8(head).expect("text");
        (head.split(' ').nth(1).and_then(|status| status.parse().ok()).expect("a status"), stream)
    }

    fn open(&self, host: &str, origin: &str, token: &str) -> (u16, TcpStream) {
        self.get(
            &format!("/socket?token={token}"),
            &format!(
                "Host: {host}\r\nOrigin: {origin}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
                 Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
            ),
        )
    }

    fn page(&self) -> Page {
        let (status, stream) = self.open(&self.host, &format!("http://{}", self.host), &self.token);
        assert_eq!(status, 101);
        Page(stream)
    }
}

impl Page {
    /// Sends a text, masked with zeros.
    fn say(&mut self, message: &Value) {
        let text = message.to_string();
        assert!(text.len() < 126);
        let mut bytes = vec![0x81, 0x80 | text.len() as u8, 0, 0, 0, 0];
        bytes.extend(text.as_bytes());
        self.0.write_all(&bytes).expect("it reads");
    }

    /// The next message.
    fn hear(&mut self) -> Value {
        let mut head = [0; 2];
        self.0.read_exact(&mut head).expect("a message");
        assert_eq!(head[0], 0x81, "a whole text");
        let length = match head[1] {
            126 => {
                let mut length = [0; 2];
                self.0.read_exact(&mut length).expect("a length");
                usize::from(u16::from_be_bytes(length))
            }
            127 => {
                let mut length = [0; 8];
                self.0.read_exact(&mut length).expect("a length");
                u64::from_be_bytes(length) as usize
            }
            length => usize::from(length),
        };
        let mut text = vec![0; length];
        self.0.read_exact(&mut text).expect("a text");
        serde_json::from_slice(&text).expect("JSON")
    }

    /// Waits for a message of a kind that is as it should be.
    fn wait_for(&mut self, kind: &str, is: impl Fn(&Value) -> bool) -> Value {
        let began = Instant::now();
        loop {
            let heard = self.hear();
            if let Some(content) = heard.get(kind).filter(|content| is(content)) {
                return content.clone();
            }
            assert!(began.elapsed() < SAFETY, "no {kind} as it should be");
        }
    }
}

#[test]
fn a_socket_is_for_an_own_page_with_the_token() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let served = Served::new(&command_line, &format!("--instance {}", command_line.instance()));
    let (host, token) = (served.host.as_str(), served.token.as_str());
    let own = format!("http://{host}");
    assert_eq!(served.open(host, &own, token).0, 101);
    assert_eq!(served.open(host, &own, "").0, 403);
    assert_eq!(served.open(host, &own, &token.replace(|digit: char| digit != '0', "1")).0, 403);
    assert_eq!(served.open(host, "http://evil.example", token).0, 403);
    let port = host.rsplit(':').next().expect("a port");
    let foreign = format!("evil.example:{port}");
    assert_eq!(served.open(&foreign, &format!("http://{foreign}"), token).0, 403, "a foreign name that leads here");
    for path in ["/", "/view.js", "/view.css"] {
        assert_eq!(served.get(path, &format!("Host: {host}\r\n")).0, 200, "{path}");
        assert_eq!(served.get(path, &format!("Host: {foreign}\r\n")).0, 403, "{path}");
    }
    assert_eq!(served.get("/../Cargo.toml", &format!("Host: {host}\r\n")).0, 404);
}

#[test]
fn whoever_opens_it_to_the_network_is_told_what_that_means() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    for (address, is_told) in [("127.0.0.1:0", false), ("0.0.0.0:0", true)] {
        let words = format!("view --instance {} --listen {address} --json", command_line.instance());
        let mut view = command_line.start(&words);
        view.wait_for_line();
        let told = view.end().stderr;
        assert_eq!(
            told.contains("everyone in the network who knows the token can look on and drive"),
            is_told,
            "{told}"
        );
    }
}

#[test]
fn one_page_drives_and_falls_silent_with_it() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let _controller = command_line.start_here("controller --lockstep --from-stand");
    let _plant = command_line.start_here("plant --lockstep --from-stand");
    command_line.wait_for_controller();
    let served = Served::new(&command_line, &format!("--instance {} --age-limit 5s", command_line.instance()));
    let (mut driver, mut onlooker) = (served.page(), served.page());
    let live = driver.wait_for("live", |_| true);
    assert_eq!(live["robot"]["joints"].as_array().map(Vec::len), Some(20));
    driver.wait_for("frame", |frame| frame["mode"] == "standing");

    driver.say(&json!({"drive": true}));
    driver.wait_for("driver", |driver| driver["you"] == true);
    onlooker.wait_for("driver", |driver| driver["you"] == false && driver["taken"] == true);
    // Neither is obeyed: what drives is another page, and what is said is nonsense.
    onlooker.say(&json!({"command": {"vx": 0.2}}));
    driver.say(&json!({"fly": true}));
    driver.say(&json!({"command": {"vx": "fast"}}));
    let answer = driver.wait_for("answer", |_| true);
    assert_eq!(answer["verdict"], "refused");
    assert!(answer["text"].as_str().is_some_and(|text| text.starts_with("invalid type: string \"fast\"")), "{answer}");

    driver.say(&json!({"command": {"vx": 0.3}}));
    let answer = driver.wait_for("answer", |_| true);
    assert_eq!(answer["verdict"], "accepted", "{answer}");
    let walks = |frame: &Value| frame["mode"] == "walking" && frame["velocity"][0].as_f64() > Some(0.1);
    onlooker.wait_for("frame", walks);
    // It is not closed: it says nothing any more.
    onlooker.wait_for("frame", |frame| frame["mode"] == "standing");
    drop(driver);
    onlooker.wait_for("driver", |driver| driver["taken"] == false);
}

#[test]
fn a_view_that_is_halted_holds_up_nothing() {
    let command_line = CommandLine::new(env!("CARGO_BIN_EXE_halfstep-under-test"));
    let walk = |folder: &str, is_watched: bool| {
        let words = format!("--lockstep --for 8s --out {folder}");
        let controller = command_line.start_here(&format!("controller {words}"));
        command_line.wait_for_controller();
        let served = is_watched.then(|| Served::new(&command_line, &format!("--instance {}", command_line.instance())));
        let mut page = served.as_ref().map(Served::page);
        let plant = command_line.start_here(&format!("plant {words}"));
        if let (Some(served), Some(page)) = (&served, &mut page) {
            page.wait_for("frame", |_| true);
            // For good: whoever waited for it would wait for ever.
            served.view.halt();
        }
        assert_eq!([controller.finish().code, plant.finish().code], [Some(0); 2]);
    };
    walk("alone", false);
    walk("watched", true);
    assert!(command_line.csv("alone", "plant") == command_line.csv("watched", "plant"), "the walk is the same");
}
