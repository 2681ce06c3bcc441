import type { ConnectionState } from '../protocol/connection';
import type { Run } from '../state/run';
import { h, part, setText } from './dom';

/** Duration of a toast [ms]. */
const kToast = 6000;

/** State of the connection: in the top bar, and as a card over the scene while waiting. */
export class Notice {
  private readonly card = part('notice');
  private readonly pill = part('connection');
  private readonly title = h('strong');
  private readonly text = h('p');
  private readonly again: HTMLElement;
  private state: ConnectionState = { kind: 'connecting', attempt: 0 };
  /** Why the page cannot work in this browser. */
  private fault: { title: string; text: string } | null = null;

  constructor(
    private readonly run: Run,
    hurry: () => void,
  ) {
    this.again = h('button', { class: 'button', type: 'button', click: hurry }, 'Try now');
    this.card.append(h('span', { class: 'spinner' }), h('div', {}, this.title, this.text), this.again);
    run.on('hello', () => this.update());
    run.on('frame', () => this.update());
    run.on('playback', () => this.update());
    run.on('error', (message) => this.toast(message));
    setInterval(() => this.update(), 500);
  }

  connection(state: ConnectionState): void {
    this.state = state;
    this.update();
  }

  /** Says why the page cannot work in this browser. */
  stop(title: string, text: string): void {
    this.fault = { title, text };
    this.update();
  }

  toast(message: string): void {
    const known = [...part('toasts').children].find((child) => child.textContent === message);
    known?.remove();
    const toast = h('div', { class: 'toast' }, message);
    part('toasts').append(toast);
    setTimeout(() => toast.remove(), kToast);
  }

  private update(): void {
    const { state, run } = this;
    const said = this.words();
    this.card.hidden = said === null;
    this.card.classList.toggle('small', run.frame !== null);
    this.card.classList.toggle('stopped', this.fault !== null);
    this.again.hidden = state.kind !== 'waiting';
    setText(this.title, said?.title ?? '');
    setText(this.text, said?.text ?? '');
    this.pill.dataset.state = state.kind;
    const word = { connecting: 'Connecting', open: 'Connected', waiting: 'Offline' }[state.kind];
    setText(this.pill, this.fault ? 'Stopped' : word);
    document.body.classList.toggle('offline', state.kind !== 'open');
  }

  private words(): { title: string; text: string } | null {
    if (this.fault) return this.fault;
    const { state, run } = this;
    const known = run.frame !== null;
    if (state.kind === 'waiting') {
      const seconds = Math.max(0, Math.ceil((state.retryAt - Date.now()) / 1000));
      const next = seconds > 0 ? `Next try in ${seconds} s.` : 'Trying again.';
      return known
        ? { title: 'Connection lost', text: `The last received frame is shown. ${next}` }
        : { title: 'mms does not answer', text: `Is "mms view" or "mms run --view" running at ${location.host}? ${next}` };
    }
    if (state.kind === 'connecting') {
      return { title: known ? 'Reconnecting' : 'Connecting', text: `to ${location.host}` };
    }
    if (known) return null;
    if (run.hello && !run.hello.live && run.hello.frames === 0) {
      return { title: 'This run has no frames', text: 'Its folder has no trajectory.' };
    }
    return { title: 'Waiting for the first frame', text: 'It appears here as soon as it is processed.' };
  }
}
