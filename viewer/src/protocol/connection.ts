import { decodeMessage } from './decode';
import type { Command, Message } from './messages';

export type ConnectionState =
  | { kind: 'connecting'; attempt: number }
  | { kind: 'open' }
  /** Waiting for the next attempt; `retryAt` is in milliseconds of Date.now(). */
  | { kind: 'waiting'; attempt: number; retryAt: number };

export interface ConnectionEvents {
  message(message: Message): void;
  state(state: ConnectionState): void;
  /** A message that could not be read; the connection goes on. */
  fault(error: Error): void;
}

const kFirstDelay = 500;
const kLongestDelay = 8000;

/** A WebSocket that comes back by itself, later and later, until the server is there again. */
export class Connection {
  private socket: WebSocket | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private attempt = 0;

  constructor(
    private readonly url: string,
    private readonly events: ConnectionEvents,
    private readonly open: (url: string) => WebSocket = (address) => new WebSocket(address),
  ) {}

  connect(): void {
    clearTimeout(this.timer);
    this.events.state({ kind: 'connecting', attempt: this.attempt });
    const socket = this.open(this.url);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => this.events.state({ kind: 'open' });
    socket.onmessage = (event: MessageEvent<unknown>) => this.receive(event.data);
    socket.onclose = () => this.retry(socket);
    this.socket = socket;
  }

  /** Tries at once where it would wait: the network is back, or the user asks. */
  hurry(): void {
    if (this.socket === null) this.connect();
  }

  /** False where nobody listens. */
  send(command: Command): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(command));
    return true;
  }

  private receive(data: unknown): void {
    if (!(data instanceof ArrayBuffer)) return;
    try {
      const message = decodeMessage(data);
      this.attempt = 0; // a server that accepts and drops us at once is still waited for longer and longer
      if (message) this.events.message(message);
    } catch (error) {
      this.events.fault(error instanceof Error ? error : new Error(String(error)));
    }
  }

  private retry(socket: WebSocket): void {
    if (socket !== this.socket) return;
    this.socket = null;
    const delay = backOff(this.attempt++);
    this.timer = setTimeout(() => this.connect(), delay);
    this.events.state({ kind: 'waiting', attempt: this.attempt, retryAt: Date.now() + delay });
  }
}

/** Milliseconds before attempt `n`: doubling, with up to a fifth at random so that pages do not come all at once. */
export function backOff(n: number, random: () => number = Math.random): number {
  return Math.min(kLongestDelay, kFirstDelay * 2 ** n) * (1 + 0.2 * random());
}
