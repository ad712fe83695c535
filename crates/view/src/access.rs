//! Who may open a socket: a page that this server has sent, opened by somebody who knows the token.

use std::net::SocketAddr;

use axum::http::{HeaderMap, header};
use rustix::io::Errno;
use rustix::rand::{GetRandomFlags, getrandom};

/// Length of a token (bytes).
const TOKEN_LEN: usize = 16;

/// The token of this process, and the names by which it may be called.
#[derive(Clone, Debug)]
pub(crate) struct Access {
    /// Whoever knows it may look on and drive.
    pub(crate) token: String,
    /// The address that it listens on.
    address: SocketAddr,
}

impl Access {
    /// A new token for a server that listens on an address.
    ///
    /// # Errors
    /// The system has no random numbers.
    pub(crate) fn new(address: SocketAddr) -> Result<Self, Errno> {
        let mut bytes = [0_u8; TOKEN_LEN];
        // So few bytes come at once.
        getrandom(&mut bytes, GetRandomFlags::empty())?;
        Ok(Self { token: bytes.iter().map(|byte| format!("{byte:02x}")).collect(), address })
    }

    /// Whether the request was sent to a name of this computer: a foreign name that leads here, as in DNS rebinding, is
    /// none.
    pub(crate) fn is_called_by_name(&self, headers: &HeaderMap) -> bool {
        let Some(host) = text(headers, header::HOST) else { return false };
        let port = self.address.port();
        let is_own = [format!("127.0.0.1:{port}"), format!("localhost:{port}"), format!("[::1]:{port}")]
            .iter()
            .chain([&self.address.to_string()])
            .any(|name| name == host);
        // Asked to listen on all addresses, it is called by names that it does not know.
        is_own || self.address.ip().is_unspecified()
    }

    /// Whether a socket may be opened: by a page of this server, with the token.
    pub(crate) fn permits(&self, headers: &HeaderMap, token: &str) -> bool {
        let host = text(headers, header::HOST).unwrap_or_default();
        let is_ours = text(headers, header::ORIGIN) == Some(&format!("http://{host}"));
        self.is_called_by_name(headers) && is_ours && is_equal(token, &self.token)
    }
}

fn text(headers: &HeaderMap, name: header::HeaderName) -> Option<&str> {
    headers.get(name)?.to_str().ok()
}

/// Compares in a time that does not tell where the texts differ.
fn is_equal(one: &str, other: &str) -> bool {
    let differences = one.bytes().zip(other.bytes()).fold(0, |all, (one, other)| all | (one ^ other));
    one.len() == other.len() && differences == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(host: &str, origin: Option<&str>) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, host.parse().unwrap());
        if let Some(origin) = origin {
            headers.insert(header::ORIGIN, origin.parse().unwrap());
        }
        headers
    }

    #[test]
    fn only_an_own_page_with_the_token_gets_a_socket() {
        let access = Access::new("127.0.0.1:8000".parse().unwrap()).unwrap();
        let token = access.token.clone();
        let permits = |host, origin, token: &str| access.permits(&headers(host, origin), token);
        assert!(permits("127.0.0.1:8000", Some("http://127.0.0.1:8000"), &token));
        assert!(permits("localhost:8000", Some("http://localhost:8000"), &token));
        for (host, origin) in [
            ("127.0.0.1:8000", None),
            ("127.0.0.1:8000", Some("http://evil.example")),
            ("127.0.0.1:8000", Some("https://127.0.0.1:8000")),
            ("127.0.0.1:8000", Some("http://localhost:8000")),
            ("127.0.0.1:8000", Some("null")),
            // A foreign name that leads here, with its own page.
            ("evil.example:8000", Some("http://evil.example:8000")),
        ] {
            assert!(!permits(host, origin, &token), "{host} {origin:?}");
        }
        for wrong in ["", "0", &token[1..], &format!("{token}0"), &token.to_uppercase().replace(['A', 'B'], "c")] {
            assert!(!permits("127.0.0.1:8000", Some("http://127.0.0.1:8000"), wrong), "{wrong}");
        }
    }

    #[test]
    fn each_token_is_another_one() {
        let tokens = [0, 1].map(|_| Access::new("127.0.0.1:1".parse().unwrap()).unwrap().token);
        assert_ne!(tokens[0], tokens[1]);
        assert_eq!(tokens.map(|token| token.len()), [2 * TOKEN_LEN; 2]);
    }

    #[test]
    fn whoever_listens_on_all_addresses_is_called_by_any_name() {
        let access = Access::new("0.0.0.0:8000".parse().unwrap()).unwrap();
        let own = headers("robot.local:8000", Some("http://robot.local:8000"));
        assert!(access.permits(&own, &access.token) && !access.permits(&own, "0"));
        assert!(!access.permits(&headers("robot.local:8000", Some("http://evil.example")), &access.token));
    }
}
