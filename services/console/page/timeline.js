// The clock of a recording: play, pace, step, scrub.

import { by, el, setText } from './dom.js';
import { fixed } from './words.js';

export class Timeline {
  constructor(say) {
    this.say = say;
    this.play = el('button', { onclick: () => say({ t: 'play', playing: !this.facts.playing }) }, 'Play');
    this.speed = el('select', { 'aria-label': 'pace', onchange: () => say({ t: 'play', playing: this.facts.playing, speed: Number(this.speed.value) }) },
      ...[0.1, 0.25, 0.5, 1, 2, 5, 10].map((x) => el('option', { value: x, selected: x === 1 }, `${x} ×`)));
    this.range = el('input', { type: 'range', min: 0, max: 1000, step: 1, 'aria-label': 'moment of the recording', oninput: () => this.scrub() });
    this.clock = el('span', {});
    this.name = el('span', { class: 'soft' });
    by('timeline').append(this.play, el('button', { onclick: () => say({ t: 'step', by: -1 }), 'aria-label': 'step back' }, '◂ Step'), el('button', { onclick: () => say({ t: 'step', by: 1 }), 'aria-label': 'step on' }, 'Step ▸'), this.speed, this.range, this.clock, this.name);
  }

  scrub() {
    this.say({ t: 'seek', at_us: Math.round((this.range.value / 1000) * this.facts.length_us) });
  }

  update(facts) {
    by('timeline').hidden = facts.kind !== 'log';
    if (facts.kind !== 'log') return;
    this.facts = facts;
    setText(this.play, facts.playing ? 'Pause' : 'Play');
    if (document.activeElement !== this.range) this.range.value = facts.length_us ? (1000 * facts.at_us) / facts.length_us : 0;
    setText(this.clock, `${fixed(facts.at_us / 1e6, 1)} of ${fixed(facts.length_us / 1e6, 1)} s${facts.reading ? ' …' : ''}`);
    setText(this.name, facts.damaged ? `${facts.file}, ${facts.damaged} damaged stretches` : facts.file);
  }
}
