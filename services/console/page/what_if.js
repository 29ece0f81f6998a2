// Futures of one's own: a sequence is chosen from what may follow, and judged; two stand side by
// side.

import { by, el, table } from './dom.js';
import { film } from './film.js';
import { actionName, fixed } from './words.js';

class Future {
  constructor(owner, name) {
    this.owner = owner;
    this.name = name;
    this.path = [];
    this.chips = el('div', { class: 'chips' });
    this.next = el('div', { class: 'chips' });
    this.result = el('div', {});
    this.element = el('div', { class: 'card' }, el('h2', {}, name), this.chips, el('p', { class: 'soft' }, 'next:'), this.next, this.result);
  }

  set(path) {
    this.path = path;
    this.asked = false;
    this.update();
  }

  // What the task's table lets follow; the search's own rules are asked when it is judged.
  allowed(task, executed) {
    const last = this.path.at(-1) ?? executed.at(-1);
    return last === undefined ? task.initial : task.actions[last].next;
  }

  update() {
    const { task, tree } = this.owner;
    if (!task || !tree.meta) return;
    this.chips.replaceChildren(...this.path.map((action, i) => el('button', { title: 'take back from here', onclick: () => this.set(this.path.slice(0, i)) }, `${i + 1}. ${actionName(task, action)} ×`)));
    const whole = tree.meta.executed.length + this.path.length >= tree.meta.plan_length;
    this.next.replaceChildren(...(whole ? [el('span', { class: 'soft' }, 'complete')] : this.allowed(task, tree.meta.executed).map((action) => el('button', { onclick: () => this.set([...this.path, action]) }, actionName(task, action)))));
    this.judge();
  }

  judge() {
    const { tree, task, pictures, say } = this.owner;
    const nodes = tree.follow(this.path);
    const known = nodes.filter((node) => node.V !== null).length;
    if (this.path.length && known < this.path.length && !tree.meta.running && !this.asked) {
      this.asked = true;
      say({ t: 'judge', search: tree.search, path: this.path });
    }
    const rows = this.path.map((action, i) => [actionName(task, action), fixed(nodes[i]?.V), fixed(nodes[i]?.f), fixed(nodes[i]?.score), nodes[i]?.mark === 'f' || nodes[i]?.mark === 'V' ? nodes[i].mark : '']);
    this.film = this.path.length ? film(pictures, task, tree.search, this.path, nodes.findIndex((node) => node.mark === 'f' || node.mark === 'V')) : null;
    this.result.replaceChildren(...(this.path.length ? [this.film.element, table(['', 'V', 'f', 'score', 'ends'], rows)] : [el('p', { class: 'soft' }, 'Choose the first action.')]));
  }
}

export class WhatIf {
  constructor(tree, pictures, say) {
    Object.assign(this, { tree, pictures, say, task: null });
    this.first = new Future(this, 'One future');
    this.second = new Future(this, 'Another');
    this.words = el('p', { class: 'bad', role: 'status' });
    by('panel-whatif').append(this.words, el('div', {}, this.first.element, this.second.element));
  }

  setTask(task) {
    this.task = task;
    this.update();
  }

  open(path) {
    const [mine, best] = [this.first, this.tree.meta?.best.path ?? []];
    mine.set(path);
    this.second.set(best);
  }

  reset() {
    this.words.textContent = '';
    this.first.set([]);
    this.second.set([]);
  }

  update() {
    this.first.update();
    this.second.update();
  }

  wrong(words) {
    this.words.textContent = words;
  }

  paint() {
    this.first.film?.paint();
    this.second.film?.paint();
  }
}
