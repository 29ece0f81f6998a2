// The buttons. None can be pressed that the state forbids: the console says which may be, and why
// not.

import { by, setText } from './dom.js';

export class Hand {
  constructor(say) {
    this.say = say;
    by('stop').onclick = () => {
      this.pressed = performance.now();
      say({ t: 'stop' });
      setText(by('hand-words'), 'stopping …');
    };
    by('run-form').onsubmit = (event) => {
      event.preventDefault();
      this.run(new FormData(event.target));
    };
  }

  run(form) {
    const threshold = form.get('threshold');
    this.say({
      t: 'run', seed: Number(form.get('seed')), goal: form.get('goal').trim(), samples: Number(form.get('samples')),
      threshold: threshold === '' ? null : Number(threshold), retries: Number(form.get('retries')), reset: form.get('reset') !== null,
    });
    by('run').disabled = true;
    setText(by('hand-words'), 'starting …');
  }

  update(facts) {
    by('hand').hidden = by('buttons').hidden = !facts.control;
    if (!facts.control) return;
    const { may, run } = facts;
    by('run').disabled = may.run !== '';
    by('stop').disabled = may.stop !== '';
    by('run').title = may.run;
    by('stop').title = may.stop;
    const ended = run && !run.running ? `The last run ended with ${run.exit}: ${run.words || 'its results'} (${run.out})` : '';
    setText(by('hand-words'), run?.running ? `seed ${run.seed} runs; results go to ${run.out}` : ended || may.run);
  }

  wrong(words) {
    setText(by('hand-words'), words);
    by('run').disabled = false;
  }
}
