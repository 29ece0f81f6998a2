// The plan strip: imagined before setting out, imagined again before each action, and what the
// camera then saw; with their difference and how surprising it was.

import { by, el } from './dom.js';
import { difference, show } from './pictures.js';
import { actionName, causeWords, fixed } from './words.js';

export class Strip {
  constructor(pictures) {
    this.pictures = pictures;
    this.columns = [];
    this.seen = new Map(); // "EPISODE/ACT" -> canvas
  }

  takeSeen(header, canvas) {
    this.seen.set(`${header.episode}/${header.act}`, canvas);
    if (this.seen.size > 200) this.seen.delete(this.seen.keys().next().value);
  }

  // One column a step: what was carried out, then what the latest plan still wants.
  steps(state) {
    const { episode } = state;
    const steps = episode.acts.map((act, i) => ({ action: act.action, act, i }));
    const { plan } = episode;
    const since = plan ? episode.acts.filter((act) => act.search === plan.search).length : 0;
    (plan?.steps ?? []).slice(since).forEach((step, k) => steps.push({
      action: step.action, score: step.score, ahead: { search: plan.search, path: plan.steps.slice(0, since + k + 1).map((s) => s.action) },
    }));
    return steps;
  }

  update(state) {
    if (!state?.task) return;
    const steps = this.steps(state);
    if (this.columns.length !== steps.length) this.build(steps.length);
    steps.forEach((step, i) => this.fill(this.columns[i], step, i, state));
  }

  build(count) {
    const column = () => ({ name: el('div', { class: 'step' }), before: this.picture(), again: this.picture(), seen: this.picture(), far: this.picture(), words: el('div', { class: 'step' }) });
    this.columns = Array.from({ length: count }, column);
    const row = (label, part) => [el('div', { class: 'label' }, label), ...this.columns.map((c, i) => {
      c[part].style.gridColumn = i + 2;
      return c[part];
    })];
    by('strip').replaceChildren(count === 0
      ? el('p', { class: 'soft' }, 'No plan yet.')
      : el('div', { class: 'strip' }, ...row('', 'name'), ...row('imagined before setting out', 'before'), ...row('imagined again', 'again'), ...row('what happened', 'seen'), ...row('difference', 'far'), ...row('surprise', 'words')));
  }

  picture() {
    return el('canvas', { class: 'picture', role: 'img' });
  }

  fill(column, step, i, state) {
    const { task, episode } = state;
    const { first } = episode;
    const name = actionName(task, step.action);
    column.name.textContent = name;
    const before = first && first.path.length > i && first.path[i] === step.action ? this.pictures.get(first.search, first.path.slice(0, i + 1), true) : null;
    const again = step.act ? this.pictures.get(step.act.search, step.act.path, true) : this.pictures.get(step.ahead.search, step.ahead.path);
    const seen = this.seen.get(`${episode.id}/${i}`) ?? null;
    this.put(column.before, before, `${name}, imagined before setting out`);
    this.put(column.again, again, `${name}, imagined again`);
    this.put(column.seen, seen, `what was seen after ${name}`);
    if (column.pair !== again || column.pairSeen !== seen) {
      [column.pair, column.pairSeen] = [again, seen];
      this.put(column.far, difference(again, seen), 'where they differ');
    }
    this.words(column.words, step, state);
  }

  put(canvas, picture, label) {
    show(canvas, picture);
    canvas.style.visibility = picture ? 'visible' : 'hidden';
    canvas.setAttribute('aria-label', label);
  }

  words(place, step, { task, episode }) {
    const { act } = step;
    if (!act) {
      place.textContent = `score ${fixed(step.score)}`;
      place.className = 'step soft';
      return;
    }
    const surprising = act.surprise !== null && act.surprise > episode.surprising;
    const surprise = act.surprise === null ? '' : ` ${fixed(act.surprise)}${surprising ? ', more than' : ' of'} ${fixed(episode.surprising)}`;
    place.textContent = (act.state === 'failed' ? `failed: ${causeWords(task, act.reason)};` : act.state) + surprise;
    place.className = `step ${act.state === 'failed' || surprising ? 'bad' : act.state === 'succeeded' ? 'good' : ''}`;
  }
}
