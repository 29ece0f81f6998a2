// Pictures that came, as canvases of their own size, and those that are still wanted.

import { pathKey } from './words.js';

const kMostKept = 1500, kAskEvery = 150, kMostAtOnce = 48;

export function toCanvas(width, height, rgb) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  const image = new ImageData(width, height);
  for (let i = 0, j = 0; i < rgb.length; i += 3, j += 4) {
    image.data[j] = rgb[i];
    image.data[j + 1] = rgb[i + 1];
    image.data[j + 2] = rgb[i + 2];
    image.data[j + 3] = 255;
  }
  canvas.getContext('2d').putImageData(image, 0, 0);
  return canvas;
}

// Draws a picture into a canvas element that is shown; null empties it.
export function show(element, picture) {
  if (element.shown === picture) return;
  element.shown = picture;
  element.width = picture?.width ?? 1;
  element.height = picture?.height ?? 1;
  if (!picture) return;
  element.style.aspectRatio = `${picture.width} / ${picture.height}`;
  element.getContext('2d').drawImage(picture, 0, 0);
}

// Where two pictures differ, light on dark, twice as strong.
export function difference(a, b) {
  if (!a || !b || a.width !== b.width || a.height !== b.height) return null;
  const [x, y] = [a, b].map((c) => c.getContext('2d').getImageData(0, 0, c.width, c.height).data);
  const rgb = new Uint8Array(3 * a.width * a.height);
  for (let i = 0, j = 0; i < x.length; i += 4, j += 3) {
    const far = Math.min(255, (2 / 3) * (Math.abs(x[i] - y[i]) + Math.abs(x[i + 1] - y[i + 1]) + Math.abs(x[i + 2] - y[i + 2])));
    rgb.fill(far, j, j + 3);
  }
  return toCanvas(a.width, a.height, rgb);
}

export class Pictures {
  // say: asks the server; arrived: called when any picture came
  constructor(say, arrived) {
    this.say = say;
    this.arrived = arrived;
    this.kept = new Map(); // key -> canvas, least recently used first
    this.asked = new Set();
    this.waiting = [];
    setInterval(() => this.ask(), kAskEvery);
  }

  forgetAsked() {
    this.asked.clear();
    this.waiting = [];
  }

  put(search, path, canvas) {
    this.kept.set(`${search}/${pathKey(path)}`, canvas);
    if (this.kept.size > kMostKept) {
      const oldest = this.kept.keys().next().value;
      this.kept.delete(oldest);
      this.asked.delete(oldest);
    }
    this.arrived();
  }

  // The picture, or null; then it is asked for. Urgent ones are asked for first.
  get(search, path, urgent = false) {
    const key = `${search}/${pathKey(path)}`;
    const picture = this.kept.get(key);
    if (picture) return picture;
    if (search && search !== '0' && !this.asked.has(key)) {
      this.asked.add(key);
      this.waiting.push({ search, path, urgent });
    }
    return null;
  }

  ask() {
    const next = this.waiting.find((wish) => wish.urgent) ?? this.waiting.at(-1);
    if (!next) return;
    const { search, urgent } = next;
    const alike = this.waiting.filter((wish) => wish.search === search && wish.urgent === urgent);
    const now = urgent ? alike.slice(0, kMostAtOnce) : alike.slice(-kMostAtOnce);
    this.waiting = this.waiting.filter((wish) => !now.includes(wish));
    this.say({ t: 'want', search, urgent, paths: now.map((wish) => wish.path) });
  }
}
