// Why it would not act: the nearest misses, each with the step that spoilt it.

import { by, el } from './dom.js';
import { film } from './film.js';
import { fixed, pathName } from './words.js';

export class Refusal {
  constructor(pictures) {
    this.pictures = pictures;
    this.films = [];
    this.told = '';
  }

  update(task, tree) {
    const { meta } = tree;
    const key = meta ? JSON.stringify([meta.id, meta.reason, meta.misses.map((m) => [m.path, m.score]), meta.tally]) : '';
    if (key === this.told) return;
    this.told = key;
    this.films = [];
    const place = by('panel-refusal');
    if (!meta) {
      place.replaceChildren(el('p', { class: 'soft' }, 'No search yet.'));
      return;
    }
    const t = meta.tally;
    const tally = `${t.complete} futures were followed to their end; ${t.p} were given up for p (the action cannot follow), ${t.f} for f (it would not finish), ${t.V} for V (no hope), ${t.score} for their score (below ${fixed(meta.limits.score)}).`;
    place.replaceChildren(
      el('p', { class: meta.reason ? 'bad' : 'good' }, meta.reason || `Not refused: the best plan scores ${fixed(meta.best.score)}.`), el('p', { class: 'soft' }, tally),
      ...meta.misses.map((miss) => this.card(task, meta.id, miss)),
    );
  }

  card(task, search, miss) {
    const shown = film(this.pictures, task, search, miss.path, miss.path.length - 1);
    this.films.push(shown);
    const last = miss.steps.at(-1);
    return el('div', { class: 'card' }, el('p', {}, pathName(task, miss.path)), shown.element, el('p', { class: 'soft' }, `${miss.why}: V ${fixed(last?.V)}, f ${fixed(last?.f)}, p ${fixed(last?.p)}, score ${fixed(miss.score)}`));
  }

  paint() {
    for (const one of this.films) one.paint();
  }
}
