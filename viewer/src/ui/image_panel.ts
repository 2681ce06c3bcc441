import type { FrameMessage } from '../protocol/messages';
import { classColor } from '../scene/palette';
import type { Run } from '../state/run';
import type { Settings } from '../state/settings';
import { part, setText } from './dom';
import { tintMask } from './mask_overlay';

/** The camera image with masks. */
export class ImagePanel {
  private readonly canvas = part<HTMLCanvasElement>('image');
  private readonly context = this.canvas.getContext('2d') as CanvasRenderingContext2D;
  private readonly toggle = part('masks');
  private image: ImageBitmap | null = null;
  private overlay: HTMLCanvasElement | null = null;
  private busy = false;
  /** The image of the frame has not arrived or is not decoded. */
  private pending = true;
  private waiting: FrameMessage | null = null;

  constructor(
    private readonly run: Run,
    private readonly settings: Settings,
  ) {
    this.toggle.setAttribute('role', 'switch');
    this.toggle.textContent = 'Masks';
    this.toggle.addEventListener('click', () => settings.toggle('masks'));
    settings.on('layer', (layer) => layer === 'masks' && this.draw());
    run.on('hello', () => this.clear());
    run.on('frame', (frame) => this.show(frame));
    this.draw();
  }

  private clear(): void {
    this.image = this.overlay = null;
    this.pending = this.run.frame === null;
    delete this.canvas.dataset.frame;
    this.draw();
  }

  /** Decoding may take longer than a frame on a slow machine: then only the newest image is decoded. */
  private show(frame: FrameMessage): void {
    if (!frame.picturesPending && !frame.image && !frame.mask) return this.clear();
    this.pending = true;
    if (frame.picturesPending) return this.draw(); // keeps the last image until the next one arrives
    this.waiting = frame;
    if (!this.busy) void this.decodeWaiting();
  }

  private async decodeWaiting(): Promise<void> {
    this.busy = true;
    while (this.waiting) {
      const { frame, image, mask } = this.waiting;
      this.waiting = null;
      const decoded = await Promise.all([decode(image, 'image/jpeg'), decode(mask, 'image/png')]);
      this.pending = false;
      this.image?.close();
      this.image = decoded[0];
      this.overlay = decoded[1] && tintMask(decoded[1], this.run.hello?.classes.map(classColor) ?? []);
      this.draw();
      this.canvas.dataset.frame = String(frame);
    }
    this.busy = false;
  }

  private draw(): void {
    const shown = this.settings.shows('masks');
    this.toggle.setAttribute('aria-checked', String(shown));
    const size = this.image ?? this.overlay ?? this.run.hello?.image;
    this.canvas.width = size?.width ?? 640;
    this.canvas.height = size?.height ?? 480;
    this.canvas.dataset.filled = String(this.image !== null || this.overlay !== null);
    setText(part('image-empty'), this.image || this.overlay ? '' : this.emptyText());
    if (this.image) this.context.drawImage(this.image, 0, 0);
    if (this.overlay && shown) this.context.drawImage(this.overlay, 0, 0, this.canvas.width, this.canvas.height);
  }

  private emptyText(): string {
    if (!this.run.hello) return '';
    if (this.run.hello.picturesNote) return this.run.hello.picturesNote;
    if (!this.run.hello.image) return 'This run has no camera images';
    return this.pending ? 'Loading image' : 'No image came with this frame';
  }
}

/** Null if there is no readable image. */
async function decode(bytes: Uint8Array | null, type: string): Promise<ImageBitmap | null> {
  if (!bytes || bytes.length === 0) return null;
  try {
    const blob = new Blob([bytes as Uint8Array<ArrayBuffer>], { type });
    return await createImageBitmap(blob, { colorSpaceConversion: 'none' });
  } catch {
    return null;
  }
}
