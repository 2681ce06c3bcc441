/** Rows of `width` floats that grow at the end; unset rows are NaN. */
export class Rows {
  private data: Float32Array;
  length = 0;

  constructor(readonly width: number) {
    this.data = new Float32Array(width * 256).fill(NaN);
  }

  /** All rows, concatenated; valid until the next write. */
  get values(): Float32Array {
    return this.data.subarray(0, this.length * this.width);
  }

  row(index: number): Float32Array {
    return this.data.subarray(index * this.width, (index + 1) * this.width);
  }

  write(index: number, values: ArrayLike<number>): void {
    this.reserve(index + Math.ceil(values.length / this.width));
    this.data.set(values, index * this.width);
    this.length = Math.max(this.length, index + Math.ceil(values.length / this.width));
  }

  private reserve(rows: number): void {
    let capacity = this.data.length / this.width;
    if (rows <= capacity) return;
    while (capacity < rows) capacity *= 2;
    const larger = new Float32Array(capacity * this.width).fill(NaN);
    larger.set(this.data);
    this.data = larger;
  }
}
