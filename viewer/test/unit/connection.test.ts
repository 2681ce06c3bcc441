import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { backOff, Connection, type ConnectionState } from '../../src/protocol/connection';
import type { Message } from '../../src/protocol/messages';
import { message } from './message';

class FakeSocket {
  static readonly OPEN = 1;
  readyState = 0;
  binaryType = '';
  sent: string[] = [];
  onopen: (() => void) | null = null;
  onclose: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;

  accept(): void {
    this.readyState = FakeSocket.OPEN;
    this.onopen?.();
  }

  drop(): void {
    this.readyState = 3;
    this.onclose?.();
  }

  send(text: string): void {
    this.sent.push(text);
  }

  close(): void {}
}

describe('Connection', () => {
  let sockets: FakeSocket[];
  let states: ConnectionState['kind'][];
  let messages: Message[];
  let faults: Error[];
  let connection: Connection;
  const last = (): FakeSocket => sockets[sockets.length - 1];

  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal('WebSocket', FakeSocket);
    [sockets, states, messages, faults] = [[], [], [], []];
    connection = new Connection(
      'ws://here/ws',
      {
        message: (one) => messages.push(one),
        state: ({ kind }) => states.push(kind),
        fault: (error) => faults.push(error),
      },
      () => {
        sockets.push(new FakeSocket());
        return last() as unknown as WebSocket;
      },
    );
    connection.connect();
  });

  it('reconnects when a server that has answered is silent', () => {
    last().accept();
    connection.send({ type: 'pause' });
    vi.advanceTimersByTime(120_000);
    connection.check();
    expect(states).not.toContain('waiting'); // nothing was heard yet
    last().onmessage?.({ data: message({ type: 'error', message: '' }) });
    vi.advanceTimersByTime(120_000);
    connection.check();
    expect(states).not.toContain('waiting'); // nothing was asked
    connection.send({ type: 'pause' });
    vi.advanceTimersByTime(59_000);
    connection.check();
    expect(states).not.toContain('waiting');
    vi.advanceTimersByTime(2000);
    connection.check();
    expect(states[states.length - 1]).toBe('waiting');
  });

  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  it('passes messages on and continues after an invalid one', () => {
    last().accept();
    last().onmessage?.({ data: new ArrayBuffer(2) });
    last().onmessage?.({ data: message({ type: 'error', message: 'disk full' }) });
    expect(faults).toHaveLength(1);
    expect(messages).toEqual([{ type: 'error', message: 'disk full' }]);
  });

  it('sends only while connected', () => {
    expect(connection.send({ type: 'play' })).toBe(false);
    last().accept();
    expect(connection.send({ type: 'seek', frame: 4 })).toBe(true);
    expect(last().sent).toEqual(['{"type":"seek","frame":4}']);
  });

  it('reconnects with growing delay, reset by messages', () => {
    const wait = (): number => {
      const before = sockets.length;
      let passed = 0;
      for (; sockets.length === before && passed < 20_000; passed += 50) vi.advanceTimersByTime(50);
      return passed;
    };
    last().drop();
    const first = wait();
    last().drop();
    const second = wait();
    last().drop();
    expect(wait()).toBeGreaterThan(second);
    expect(second).toBeGreaterThan(first);
    last().accept();
    last().onmessage?.({ data: message({ type: 'error', message: '' }) });
    last().drop();
    expect(wait()).toBeLessThan(second);
    expect(states.slice(0, 3)).toEqual(['connecting', 'waiting', 'connecting']);
  });

  it('hurries only while waiting', () => {
    connection.hurry();
    expect(sockets).toHaveLength(1);
    last().drop();
    connection.hurry();
    expect(sockets).toHaveLength(2);
    vi.advanceTimersByTime(60_000);
    expect(sockets).toHaveLength(2);
  });
});

describe('backOff', () => {
  it('doubles up to a limit', () => {
    const delays = [0, 1, 2, 10].map((attempt) => backOff(attempt, () => 0));
    expect(delays).toEqual([500, 1000, 2000, 8000]);
    expect(backOff(0, () => 1)).toBe(600);
  });
});
