// The WebSocket to the console: begins anew by itself when it is lost, and says so.

const kFirstWait = 300, kLongestWait = 3000;

export class Connection {
  // handlers: {data, picture, facts, choices, wrong, state(text, lost)}
  constructor(handlers) {
    this.handlers = handlers;
    this.wait = kFirstWait;
    this.begin();
  }

  begin() {
    const token = new URLSearchParams(location.hash.slice(1)).get('token');
    const socket = new WebSocket(`ws://${location.host}/live${token ? `?token=${encodeURIComponent(token)}` : ''}`);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.wait = kFirstWait;
      this.handlers.state('connected', false);
    };
    socket.onmessage = (event) => this.take(event.data);
    socket.onclose = () => {
      this.socket = null;
      this.handlers.state('connection lost: trying again', true);
      setTimeout(() => this.begin(), this.wait);
      this.wait = Math.min(2 * this.wait, kLongestWait);
    };
    this.socket = socket;
  }

  take(message) {
    if (message instanceof ArrayBuffer) {
      const length = new DataView(message).getUint32(0, true);
      const header = JSON.parse(new TextDecoder().decode(new Uint8Array(message, 4, length)));
      this.handlers.picture(header, new Uint8Array(message, 4 + length));
      return;
    }
    const content = JSON.parse(message);
    this.handlers[content.t]?.(content);
  }

  say(request) {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(request));
  }
}
