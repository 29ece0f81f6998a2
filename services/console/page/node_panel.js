// All that is known of one node.

import { by, el, table, terms } from './dom.js';
import { Player } from './film.js';
import { actionName, fixed, pathName } from './words.js';

const kMarks = { f: 'ended: the action would not finish (f)', V: 'ended: no hope from here on (V)', end: 'the plan is complete here' };

export class NodePanel {
  // handlers: {say(request), whatIf(path)}
  constructor(tree, pictures, handlers) {
    this.tree = tree;
    this.handlers = handlers;
    this.player = new Player(pictures);
    this.title = el('h3', {});
    this.list = el('dl', {});
    this.choices = el('div', {});
    this.help = el('p', { class: 'soft' }, 'Point at a node of the tree, or choose one with the arrow keys. A click plays its future as a film.');
    this.button = el('button', { onclick: () => this.node && handlers.whatIf(this.tree.pathOf(this.node)) }, 'What if …');
    by('panel-node').append(this.help, this.title, this.player.element, this.list, this.button, this.choices);
    this.show(null, null);
  }

  show(task, node, chosen = false) {
    this.task = task;
    const other = node !== this.node;
    this.node = node;
    this.help.hidden = Boolean(node);
    for (const part of [this.title, this.player.element, this.list, this.button, this.choices]) part.hidden = !node;
    if (!node) return;
    const path = this.tree.pathOf(node);
    this.title.textContent = pathName(task, path);
    if (other || chosen) {
      this.player.play(task, this.tree.search, path);
      this.choices.replaceChildren();
      this.handlers.say({ t: 'choices', search: this.tree.search, node: node.id });
    }
    terms(this.list, [
      ['V', `${fixed(node.V, 4)} success from here on`], ['f', `${fixed(node.f, 4)} the action finishes`], ['p', `${fixed(node.p, 4)} it may follow`], ['Q', `${fixed(node.Q, 4)}`],
      ['N', `${node.N} visits`], ['W / N', fixed(node.mean, 4)], ['v*', fixed(node.best, 4)], ['score', `${fixed(node.score, 4)} (V times f along the path)`],
      ['by', node.server < 0 ? '–' : `model server ${this.tree.meta?.servers[node.server] ?? node.server}`],
      ['state', kMarks[node.mark] ?? (node.N ? 'followed further' : 'not visited')],
    ]);
  }

  // Q and p of what may come next: also of what was never imagined.
  takeChoices({ search, node, choices }) {
    if (!this.node || search !== this.tree.search || node !== this.node.id || !choices) return;
    const least = this.tree.meta?.limits.p ?? 0;
    const rows = choices.sort((a, b) => b.p - a.p).map((c) => [actionName(this.task, c.action), fixed(c.Q, 3), fixed(c.p, 3), c.p < least ? 'ruled out by p' : c.node < 0 ? 'not tried' : this.tree.nodes[c.node]?.N ?? 0]);
    this.choices.replaceChildren(el('h2', {}, 'Next'), table(['action', 'Q', 'p', 'N'], rows));
  }
}
