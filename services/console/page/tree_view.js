// The tree on its canvas: zoom and pan (d3), keys, hover, folding, peeking; the best plan framed.

import { colours } from './colours.js';
import { by, setText } from './dom.js';
import { show } from './pictures.js';
import { layOut } from './tree_layout.js';
import { paintTree } from './tree_paint.js';
import { actionName, count, fixed, pathName } from './words.js';

const kLevel = 150, kRow = 24, kSmooth = 0.25, kBigTree = 5000, kLayoutEvery = 250;
// The browser may have to share its processors with the search that it shows.
const kWhileThinking = 100;

export class TreeView {
  // tree: TreeData; handlers: {select(node), hover(node)}
  constructor(tree, pictures, handlers) {
    this.tree = tree;
    this.pictures = pictures;
    this.handlers = handlers;
    this.canvas = by('tree');
    this.context = this.canvas.getContext('2d');
    this.transform = d3.zoomIdentity;
    this.extent = { rows: 1, levels: 1 };
    this.follow = 'plan'; // what is kept in view until somebody zooms
    this.found = new Set();
    this.onPlan = new Set();
    this.drawn = [];
    this.frames = [];
    this.laid = -1;
    this.laidAt = 0;
    this.paintedAt = 0;
    this.dirty = true;
    this.zoom = d3.zoom().scaleExtent([0.005, 12]).filter(() => !d3.event.ctrlKey && !d3.event.button).on('zoom', () => this.zoomed());
    d3.select(this.canvas).call(this.zoom).on('dblclick.zoom', null);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.touch());
    this.listen();
    requestAnimationFrame(() => this.frame());
  }

  listen() {
    this.canvas.addEventListener('pointermove', (event) => this.pointed(event));
    this.canvas.addEventListener('pointerleave', () => this.hover(null));
    this.canvas.addEventListener('click', (event) => this.select(this.nearest(event)));
    this.canvas.addEventListener('dblclick', (event) => {
      const node = this.nearest(event);
      if (node) this.tree.fold(node);
      this.touch();
    });
    this.canvas.addEventListener('keydown', (event) => this.key(event));
    this.canvas.addEventListener('keyup', (event) => event.key === ' ' && this.peek(null));
    this.canvas.addEventListener('blur', () => this.peek(null));
    by('zoom-in').onclick = () => this.scaleBy(1.5);
    by('zoom-out').onclick = () => this.scaleBy(1 / 1.5);
    by('fit').onclick = () => this.fit('all');
    by('fit-plan').onclick = () => this.fit('plan');
    by('find').oninput = (event) => this.find(event.target.value);
  }

  touch() {
    this.dirty = true;
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.max(1, Math.round(clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(clientHeight * ratio));
    this.ratio = ratio;
    if (this.follow) this.fit(this.follow);
    this.touch();
  }

  zoomed() {
    this.transform = d3.event.transform;
    if (d3.event.sourceEvent) this.follow = null;
    this.touch();
  }

  scaleBy(factor) {
    this.follow = null;
    this.zoom.scaleBy(d3.select(this.canvas), factor);
  }

  // What the plan, or the whole tree, needs to be in view.
  fit(what) {
    this.follow = what;
    const { clientHeight: height } = this.canvas;
    const plan = this.tree.root ? [this.tree.root, ...this.planNodes()] : [];
    let [top, bottom] = [0, this.extent.rows - 1];
    if (what === 'plan' && plan.length > 1) {
      [top, bottom] = d3.extent(plan, (node) => node.y);
      // Its neighbours, too, so far as rows stay tall enough for pictures.
      const spare = Math.max(2, Math.min(this.extent.rows, height / 34) - (bottom - top));
      [top, bottom] = [Math.max(0, top - spare / 2), Math.min(this.extent.rows - 1, bottom + spare / 2)];
    }
    const k = Math.max(0.005, Math.min(4, (height - 30) / (kRow * (bottom - top + 1))));
    const y = height / 2 - kRow * k * (top + bottom) / 2;
    this.zoom.transform(d3.select(this.canvas), d3.zoomIdentity.translate(Math.max(30, Math.min(40 * k, 60)), y).scale(k));
  }

  // Levels never come so close that nothing could be told apart, nor too far.
  level() {
    const room = this.canvas.clientWidth / (this.extent.levels + 0.6);
    if (this.follow) return Math.max(room, 24);
    return Math.max(room, Math.min(kLevel * this.transform.k, 2.5 * room), 24);
  }

  planNodes() {
    return this.tree.meta ? this.tree.follow(this.tree.meta.best.path) : [];
  }

  // The tree has changed: rows, a plan, another search.
  changed() {
    this.onPlan = new Set(this.planNodes());
    this.touch();
    const { meta } = this.tree;
    by('tree-empty').hidden = this.tree.size > 1;
    setText(by('tree-words'), meta ? `${count(meta.rollouts)} of ${count(meta.samples)} rollouts, ${count(this.tree.size)} nodes${meta.cut ? ', cut: no memory for more' : ''}${meta.running ? '' : ', over'}` : '');
  }

  reset() {
    this.selected = this.hovered = null;
    this.found.clear();
    this.laid = -1;
    this.follow = 'plan';
    this.changed();
  }

  find(text) {
    const wanted = text.trim().toLowerCase();
    this.found = new Set();
    if (wanted) {
      for (const node of this.tree.nodes) {
        if (node && actionName(this.task, node.action).toLowerCase().includes(wanted)) this.found.add(node);
      }
      const first = [...this.found].sort((a, b) => b.N - a.N)[0];
      if (first) this.select(first, true);
    }
    setText(by('node-words'), wanted ? `${this.found.size} nodes found` : '');
    this.touch();
  }

  nearest(event) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    let best = null, far = Math.max(14, this.size ?? 0) ** 2;
    for (const node of this.drawn) {
      const d = (node.sx - x) ** 2 + (node.sy - y) ** 2;
      if (d < far) [best, far] = [node, d];
    }
    return best;
  }

  pointed(event) {
    this.hover(this.nearest(event));
  }

  hover(node) {
    if (node === this.hovered) return;
    this.hovered = node;
    this.canvas.style.cursor = node ? 'pointer' : 'grab';
    this.handlers.hover(node);
    this.touch();
  }

  select(node, centre = false) {
    this.selected = node;
    this.handlers.select(node);
    this.touch();
    if (!node) return;
    setText(by('node-words'), `${pathName(this.task, this.tree.pathOf(node))}: V ${fixed(node.V)}, f ${fixed(node.f)}, ${node.N} visits`);
    const away = node.sy < 20 || node.sy > this.canvas.clientHeight - 20 || !this.drawn.includes(node);
    if (centre || away) this.centre(node);
  }

  centre(node) {
    this.follow = null;
    this.relay(true);
    const k = this.transform.k;
    this.zoom.transform(d3.select(this.canvas), d3.zoomIdentity.translate(this.transform.x, this.canvas.clientHeight / 2 - node.y * kRow * k).scale(k));
  }

  key(event) {
    const node = this.selected ?? this.tree.root;
    const near = (step) => node?.parent?.children[node.parent.children.indexOf(node) + step];
    const moves = { ArrowLeft: () => node?.parent, ArrowRight: () => d3.greatest?.(node?.children ?? [], (a, b) => a.N - b.N) ?? [...(node?.children ?? [])].sort((a, b) => b.N - a.N)[0], ArrowUp: () => near(-1), ArrowDown: () => near(1), Home: () => this.tree.root };
    const acts = { '+': () => this.scaleBy(1.5), '=': () => this.scaleBy(1.5), '-': () => this.scaleBy(1 / 1.5), 0: () => this.fit('all'), p: () => this.fit('plan'), Enter: () => node && this.tree.fold(node), '/': () => by('find').focus(), ' ': () => this.peek(this.hovered ?? node), Escape: () => this.select(null) };
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (moves[event.key]) {
      const next = moves[event.key]();
      if (next) this.select(next);
    } else if (acts[event.key]) {
      acts[event.key]();
    } else {
      return;
    }
    event.preventDefault();
    this.touch();
  }

  // While the key is held: one node, large; nothing else changes, so there is nothing to undo.
  peek(node) {
    by('peek').hidden = !node;
    this.peeked = node;
    if (node) this.showPeek();
  }

  showPeek() {
    const path = this.tree.pathOf(this.peeked);
    show(by('peek-picture'), this.pictures.get(this.tree.search, path));
    setText(by('peek-words'), `${pathName(this.task, path)}: V ${fixed(this.peeked.V)}, f ${fixed(this.peeked.f)}, score ${fixed(this.peeked.score)}, ${this.peeked.N} visits`);
  }

  // A large tree is laid out a few times a second; a small one whenever it changes.
  relay(now = false) {
    if (!this.tree.root || this.laid === this.tree.shapeVersion) return;
    if (!now && this.tree.size > kBigTree && performance.now() - this.laidAt < kLayoutEvery) return;
    this.extent = layOut(this.tree.root);
    this.laid = this.tree.shapeVersion;
    this.laidAt = performance.now();
    this.onPlan = new Set(this.planNodes());
    if (this.follow) this.fit(this.follow);
    this.touch();
  }

  // Nodes glide to where they belong; new ones come out of their parent.
  glide() {
    let moving = false;
    for (const node of this.drawn) {
      if (node.shownX === undefined) [node.shownX, node.shownY] = [node.parent?.shownX ?? node.x, node.parent?.shownY ?? node.y];
      const [dx, dy] = [node.x - node.shownX, node.y - node.shownY];
      const near = Math.abs(dx) < 0.01 && Math.abs(dy) * kRow * this.transform.k < 0.5;
      node.shownX = near ? node.x : node.shownX + kSmooth * dx;
      node.shownY = near ? node.y : node.shownY + kSmooth * dy;
      moving ||= !near;
    }
    return moving;
  }

  frame() {
    requestAnimationFrame(() => this.frame());
    const begun = performance.now();
    if (this.tree.meta?.running && begun - this.paintedAt < kWhileThinking) return;
    this.relay();
    if (!this.dirty) return;
    this.dirty = false;
    this.paintedAt = begun;
    this.paint();
    this.frames.push(performance.now() - begun);
    if (this.frames.length > 300) this.frames.shift();
  }

  paint() {
    const { context, canvas, transform } = this;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.fillStyle = colours().ground;
    context.fillRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    if (!this.tree.root) {
      this.drawn = [];
      return;
    }
    const row = kRow * transform.k, level = this.level();
    const left = transform.x;
    const { drawn, size } = paintTree({
      context, root: this.tree.root, row, level, width: canvas.clientWidth, height: canvas.clientHeight,
      x: (depth) => left + depth * level, y: (at) => transform.y + at * row,
      onPlan: this.onPlan, found: this.found, selected: this.selected, hovered: this.hovered,
      rootVisits: this.tree.root.N, task: this.task, picture: (node) => this.pictures.get(this.tree.search, this.tree.pathOf(node)),
    });
    this.drawn = drawn;
    this.size = size;
    if (this.glide()) this.touch();
    if (this.peeked) this.showPeek();
  }
}
