/** Number of points per image, adapted to previous rendering times. */
export class PointBudget {
  /** `target`: time per image [ms]; `fewest` to `most` points, initially `points`. */
  constructor(
    private readonly target: number,
    private readonly fewest: number,
    private readonly most: number,
    public points: number,
  ) {}

  /**
   * Reports the time of an image with `points` points [ms]. The number at most doubles, so that the next image is not
   * slow.
   */
  learn(points: number, took: number): void {
    const wanted = (this.target * Math.max(points, this.fewest)) / Math.max(1, took);
    this.points = Math.min(this.most, 2 * this.points, Math.max(this.fewest, wanted));
  }
}

/** Whether the CPU renders: then without anti-aliasing and high resolution. */
export function rendersInSoftware(): boolean {
  const context = document.createElement('canvas').getContext('webgl2');
  const info = context?.getExtension('WEBGL_debug_renderer_info');
  if (!context || !info) return false;
  const name = String(context.getParameter(info.UNMASKED_RENDERER_WEBGL));
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
