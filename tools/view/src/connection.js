// The socket to the server: messages out, messages in, and a new socket after a lost one.

const RETRY = 1000;

export class Connection {
  constructor(handlers) {
    this.handlers = handlers;
    this.token = new URLSearchParams(location.hash.slice(1)).get('token') ?? '';
    this.#open();
  }

  #open() {
    this.socket = new WebSocket(`ws://${location.host}/socket?token=${this.token}`);
    this.socket.onmessage = ({ data }) => {
      const [[kind, content]] = Object.entries(JSON.parse(data));
      this.handlers[kind]?.(content);
    };
    this.socket.onclose = () => {
      this.handlers.lost();
      setTimeout(() => this.#open(), RETRY);
    };
  }

  /** Sends a message, or loses it without a connection. */
  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
}
