// A future as a row of imagined pictures, and as a short film.

import { el } from './dom.js';
import { show } from './pictures.js';
import { actionName } from './words.js';

const kFrameMs = 600;

// figures for path[0..n]; `spoilt`: index of the step that ended it, or -1. Returns {element, paint()}.
export function film(pictures, task, search, path, spoilt = -1) {
  const figures = path.map((action, i) => {
    const canvas = el('canvas', { class: 'picture', role: 'img', 'aria-label': `imagined after ${actionName(task, action)}` });
    return { canvas, figure: el('figure', { class: i === spoilt ? 'spoilt' : '' }, canvas, el('figcaption', {}, actionName(task, action))) };
  });
  const paint = () => figures.forEach(({ canvas }, i) => show(canvas, pictures.get(search, path.slice(0, i + 1))));
  paint();
  return { element: el('div', { class: 'film' }, ...figures.map((f) => f.figure)), paint };
}

// One canvas that shows the pictures one after the other, over and over.
export class Player {
  constructor(pictures) {
    this.pictures = pictures;
    this.canvas = el('canvas', { class: 'picture', role: 'img', 'aria-label': 'an imagined future as a film' });
    this.words = el('p', { class: 'soft' });
    this.element = el('div', {}, this.canvas, this.words);
    this.at = 0;
    setInterval(() => this.turn(), kFrameMs);
  }

  play(task, search, path) {
    Object.assign(this, { task, search, path, at: 0 });
    this.turn();
  }

  turn() {
    if (!this.path || !this.element.isConnected || this.element.closest('[hidden]')) return;
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    const length = still ? this.path.length : this.at % (this.path.length + 1);
    show(this.canvas, this.pictures.get(this.search, this.path.slice(0, length)));
    this.words.textContent = length ? `${length}. ${actionName(this.task, this.path[length - 1])}` : 'now, as the networks see it';
    this.at += 1;
  }
}
