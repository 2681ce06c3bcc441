/** How long a picture may take while the scene moves, and when it rests [ms]. */
const kMoving = 40;
const kResting = 500;
const kFewest = 60_000;

/** How many points a picture may have, learned from what pictures took so far. */
export class PointBudget {
  moving: number;
  resting: number;

  /** `most` is never exceeded; `start` is what a moving scene begins with. */
  constructor(
    private readonly most: number,
    start: number,
  ) {
    this.moving = start;
    this.resting = most;
  }

  /** A picture of so many points took so long. */
  learn(points: number, milliseconds: number): void {
    const perMillisecond = Math.max(points, kFewest) / Math.max(1, milliseconds);
    this.moving = this.toward(this.moving, kMoving * perMillisecond);
    this.resting = this.toward(this.resting, kResting * perMillisecond);
  }

  /** At most twice as many as before, so that one quick picture does not make the next one slow. */
  private toward(before: number, wanted: number): number {
    return Math.min(this.most, 2 * before, Math.max(kFewest, wanted));
  }
}

/** Whether pictures are drawn by the processor: then edges are not smoothed and pixels not doubled. */
export function rendersInSoftware(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const info = context?.getExtension('WEBGL_debug_renderer_info');
  if (!context || !info) return false;
  const name = String(context.getParameter(info.UNMASKED_RENDERER_WEBGL));
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
