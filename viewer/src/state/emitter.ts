/** Calls listeners; `Events` maps a topic to its argument. */
export class Emitter<Events extends Record<string, unknown>> {
  private readonly listeners = new Map<keyof Events, Set<(value: never) => void>>();

  on<Topic extends keyof Events>(topic: Topic, listener: (value: Events[Topic]) => void): void {
    const known = this.listeners.get(topic) ?? new Set();
    known.add(listener as (value: never) => void);
    this.listeners.set(topic, known);
  }

  emit<Topic extends keyof Events>(topic: Topic, value: Events[Topic]): void {
    this.listeners.get(topic)?.forEach((listener) => (listener as (value: Events[Topic]) => void)(value));
  }
}
