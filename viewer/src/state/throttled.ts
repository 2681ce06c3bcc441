/** Runs `action` at most once per `ms`, and once more at the end. */
export function throttled(ms: number, action: () => void): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let due = false;
  const run = (): void => {
    if (timer !== undefined) {
      due = true;
      return;
    }
    action();
    timer = setTimeout(() => {
      timer = undefined;
      if (due) {
        due = false;
        run();
      }
    }, ms);
  };
  return run;
}
