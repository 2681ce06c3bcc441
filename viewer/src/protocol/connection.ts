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
  /** A message could not be decoded; the connection continues. */
  fault(error: Error): void;
}

const kFirstDelay = 500;
const kLongestDelay = 8000;
/** A server that does not answer a command for longer is gone [ms]. */
const kSilence = 60_000;

/** A WebSocket that reconnects automatically with increasing delays. */
export class Connection {
  private socket: WebSocket | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private attempt = 0;
  /** Time of the first command without an answer [ms]; 0: none. */
  private asked = 0;
  /** Before its first frame a live run answers nothing. */
  private heard = false;

  constructor(
    private readonly url: string,
    private readonly events: ConnectionEvents,
    private readonly open: (url: string) => WebSocket = (address) => new WebSocket(address),
  ) {}

  connect(): void {
    clearTimeout(this.timer);
    this.asked = 0;
    this.heard = false;
    this.events.state({ kind: 'connecting', attempt: this.attempt });
    const socket = this.open(this.url);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => this.events.state({ kind: 'open' });
    socket.onmessage = (event: MessageEvent<unknown>) => this.receive(event.data);
    socket.onclose = () => this.retry(socket);
    this.socket = socket;
  }

  /** Retries immediately: the network is available again, or the user requests it. */
  hurry(): void {
    if (this.socket === null) this.connect();
  }

  /** Reconnects if the server has not answered for long. */
  check(): void {
    const socket = this.socket;
    if (socket === null || this.asked === 0 || Date.now() - this.asked < kSilence) return;
    socket.close();
    this.retry(socket); // closing may take minutes
  }

  /** False if there is no connection. */
  send(command: Command): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(command));
    if (this.heard && this.asked === 0) this.asked = Date.now();
    return true;
  }

  private receive(data: unknown): void {
    if (!(data instanceof ArrayBuffer)) return;
    this.asked = 0;
    this.heard = true;
    try {
      const message = decodeMessage(data);
      this.attempt = 0; // also increases the delay for a server that accepts and closes immediately
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

/** Milliseconds before attempt `n`: doubling, plus up to 20 % at random to spread reconnects. */
export function backOff(n: number, random: () => number = Math.random): number {
  return Math.min(kLongestDelay, kFirstDelay * 2 ** n) * (1 + 0.2 * random());
}
