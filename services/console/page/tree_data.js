// The nodes of one search, as rows of the console tell them.

const kUnknown = { N: 0, mean: 0, best: 0, V: null, f: null, Q: null, p: null, score: null, mark: '', server: -1 };

export class TreeData {
  constructor() {
    this.clear(null);
  }

  clear(search) {
    this.search = search;
    this.nodes = [];
    this.size = 0;
    this.meta = null;
    this.shapeVersion = 0; // grows when a node comes or folds
    this.version = 0;
  }

  // A node whose row has not come yet is there all the same where a child's came first.
  at(id) {
    let node = this.nodes[id];
    if (!node) {
      node = { id, parent: null, action: -1, depth: 0, children: [], folded: false, known: false, x: 0, y: 0, ...kUnknown };
      this.nodes[id] = node;
      this.size += 1;
    }
    return node;
  }

  take(rows) {
    for (const [id, parent, action, N, mean, best, V, f, Q, p, score, mark, server] of rows) {
      const node = this.at(id);
      Object.assign(node, { action, N, mean, best, V, f, Q, p, score, mark, server });
      if (!node.known) {
        node.known = true;
        if (parent >= 0) this.hang(node, this.at(parent));
        this.shapeVersion += 1;
      }
    }
    this.version += 1;
  }

  // Children stand in the order of their actions, so that nothing jumps while visits change.
  hang(node, parent) {
    node.parent = parent;
    let place = parent.children.length;
    while (place > 0 && parent.children[place - 1].action > node.action) place -= 1;
    parent.children.splice(place, 0, node);
  }

  get root() {
    return this.nodes[0] ?? null;
  }

  pathOf(node) {
    const path = [];
    for (let at = node; at?.parent; at = at.parent) path.push(at.action);
    return path.reverse();
  }

  // The node at the end of a path, or as far as it is known.
  follow(path) {
    const nodes = [];
    let node = this.root;
    for (const action of path) {
      node = node?.children.find((child) => child.action === action);
      if (!node) break;
      nodes.push(node);
    }
    return nodes;
  }

  fold(node, folded = !node.folded) {
    if (!node.children.length) return;
    node.folded = folded;
    this.shapeVersion += 1;
  }
}
