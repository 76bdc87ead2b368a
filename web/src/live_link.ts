import { PROTOCOL, type ClientMessage, type ServerMessage } from './protocol';

const FIRST_WAIT = 500; // ms, before it connects again
const MOST_WAIT = 5000;
const SILENCE = 10000; // ms: a connection on which nothing was heard at its begin is given up

export type LinkState = 'connecting' | 'open' | 'lost' | 'foreign';

export interface LinkEvents {
  onMessage: (message: ServerMessage) => void;
  onState: (state: LinkState) => void;
}

/** The WebSocket to the server of this page; made again whenever it is lost. */
export class LiveLink {
  private socket: WebSocket | undefined;
  private wait = FIRST_WAIT;

  constructor(private readonly events: LinkEvents) {
    this.connect();
  }

  /** Nothing happens while there is no connection. */
  send(message: ClientMessage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private connect(): void {
    this.events.onState('connecting');
    // Behind the # the server does not see it, and no log does.
    const token = new URLSearchParams(window.location.hash.slice(1)).get('token');
    const query = token ? `?token=${encodeURIComponent(token)}` : '';
    const socket = new WebSocket(`${window.location.protocol.replace('http', 'ws')}//${window.location.host}/socket${query}`);
    this.socket = socket;
    const patience = window.setTimeout(() => { socket.close(); }, SILENCE);
    socket.addEventListener('message', (event) => {
      window.clearTimeout(patience);
      if (socket === this.socket) this.take(JSON.parse(String(event.data)) as ServerMessage);
    });
    socket.addEventListener('close', () => {
      window.clearTimeout(patience);
      if (socket !== this.socket) return;
      this.events.onState('lost');
      window.setTimeout(() => { this.connect(); }, this.wait);
      this.wait = Math.min(MOST_WAIT, 2 * this.wait);
    });
  }

  private take(message: ServerMessage): void {
    if (message.type === 'hello') {
      if (message.protocol !== PROTOCOL) {
        this.socket?.close();
        this.socket = undefined;
        this.events.onState('foreign');
        return;
      }
      this.wait = FIRST_WAIT;
      this.events.onState('open');
    }
    this.events.onMessage(message);
  }
}
