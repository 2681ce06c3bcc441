/** How many points a picture may have, learned from what pictures took so far. */
export class PointBudget {
  /** `target` is how long a picture may take [ms]; it has `fewest` to `most` points, and `points` at first. */
  constructor(
    private readonly target: number,
    private readonly fewest: number,
    private readonly most: number,
    public points: number,
  ) {}

  /** A picture of so many points took so long [ms]. At most doubles: one quick picture shall not make the next slow. */
  learn(points: number, took: number): void {
    const wanted = (this.target * Math.max(points, this.fewest)) / Math.max(1, took);
    this.points = Math.min(this.most, 2 * this.points, Math.max(this.fewest, wanted));
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
