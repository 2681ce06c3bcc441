import { type Camera, Vector3 } from 'three';

export interface Label {
  /** In the scene frame; the label is above it. */
  at: Vector3;
  text: string;
  color: string;
  faint: boolean;
}

interface Rectangle {
  x: number;
  y: number;
  width: number;
  height: number;
}

const kFont = '600 12px system-ui, "Segoe UI", Roboto, sans-serif';
const kHeight = 20;
/** How often a label moves up to avoid others before it is omitted. */
const kMoves = 4;

/** Labels of objects, drawn over the scene on a separate canvas, near ones first, without overlap. */
export class LabelOverlay {
  readonly canvas = document.createElement('canvas');
  private readonly context = this.canvas.getContext('2d') as CanvasRenderingContext2D;
  private width = 0;
  private height = 0;
  private ratio = 1;

  resize(width: number, height: number, ratio: number): void {
    [this.width, this.height, this.ratio] = [width, height, ratio];
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
  }

  draw(labels: Label[], camera: Camera): void {
    const { context } = this;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    context.font = kFont;
    context.textBaseline = 'middle';
    const taken: Rectangle[] = [];
    for (const { label, x, y } of this.project(labels, camera)) {
      const width = context.measureText(label.text).width + 22;
      const box = { x: x - width / 2, y: y - kHeight - 6, width, height: kHeight };
      for (let moved = 0; moved < kMoves && hits(box, taken); ++moved) box.y -= kHeight + 2;
      if (hits(box, taken)) continue;
      taken.push(box);
      this.drawOne(label, box);
    }
  }

  private project(labels: Label[], camera: Camera): { label: Label; x: number; y: number; depth: number }[] {
    const point = new Vector3();
    return labels
      .map((label) => {
        point.copy(label.at).project(camera);
        const [x, y] = [((point.x + 1) / 2) * this.width, ((1 - point.y) / 2) * this.height];
        return { label, x, y, depth: point.z };
      })
      .filter(({ x, y, depth }) => Math.abs(depth) < 1 && x > 0 && y > 0 && x < this.width && y < this.height)
      .sort((a, b) => a.depth - b.depth);
  }

  private drawOne({ text, color, faint }: Label, { x, y, width, height }: Rectangle): void {
    const { context } = this;
    context.globalAlpha = faint ? 0.6 : 1;
    context.fillStyle = 'rgba(10, 14, 20, 0.82)';
    context.beginPath();
    context.roundRect(x, y, width, height, 6);
    context.fill();
    context.fillStyle = color;
    context.beginPath();
    context.arc(x + 9, y + height / 2, 3.5, 0, 2 * Math.PI);
    context.fill();
    context.fillStyle = '#eef3f8';
    context.fillText(text, x + 16, y + height / 2 + 0.5);
    context.globalAlpha = 1;
  }
}

function hits(box: Rectangle, others: Rectangle[]): boolean {
  return others.some((other) => overlap(box, other));
}

function overlap(a: Rectangle, b: Rectangle): boolean {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}
