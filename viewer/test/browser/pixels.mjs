// Pixel counts of screenshots of the page, computed in the browser.

/** Counts red pixels of the people's boxes, green ones of the vehicles', and those lighter than the background. */
export async function countPixels(page, locator) {
  const picture = (await locator.screenshot()).toString('base64');
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width: image.width, height: image.height });
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const count = { all: data.length / 4, lit: 0, red: 0, green: 0, sum: 0 };
    for (let i = 0; i < data.length; i += 4) {
      const [r, g, b] = data.subarray(i, i + 3);
      if (Math.max(r, g, b) > 70) ++count.lit;
      if (r > 200 && g < 130 && b < 140 && r - Math.max(g, b) > 90) ++count.red;
      if (g > 150 && r < 130 && b < 170 && g - Math.max(r, b) > 60) ++count.green;
      count.sum = (count.sum + (i + 1) * (r + 3 * g + 7 * b)) % 1_000_000_007;
    }
    return count;
  }, picture);
}

/** Waits until `accept` is true for the value of `measure`; rendering on a CPU is slow. */
export async function eventually(what, measure, accept, timeout = 40_000) {
  const end = Date.now() + timeout;
  let value = await measure();
  while (!accept(value)) {
    if (Date.now() > end) throw new Error(`${what}: not within ${timeout / 1000} s, at last ${JSON.stringify(value)}`);
    await new Promise((resolve) => setTimeout(resolve, 150));
    value = await measure();
  }
  return value;
}
