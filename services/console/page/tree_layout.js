// Where nodes stand: depth to the right (x, in levels), leaves one below the other (y, in rows), a
// parent in the middle of its children. Each node also gets the rows that its subtree takes (top,
// bottom), by which what is out of view is passed over whole.

export function layOut(root) {
  let rows = 0;
  // Without recursion: children come after their parent in `order`, so backwards they come first.
  const order = [root];
  root.depth = 0;
  for (let i = 0; i < order.length; i += 1) {
    const node = order[i];
    if (node.folded) continue;
    for (let c = 0; c < node.children.length; c += 1) {
      node.children[c].depth = node.depth + 1;
      order.push(node.children[c]);
    }
  }
  const leaves = [root];
  while (leaves.length) {
    const node = leaves.pop();
    node.x = node.depth;
    if (node.folded || !node.children.length) {
      node.y = node.top = node.bottom = rows;
      rows += 1;
    } else {
      for (let c = node.children.length - 1; c >= 0; c -= 1) leaves.push(node.children[c]);
    }
  }
  for (let i = order.length - 1; i >= 0; i -= 1) {
    const { children, folded } = order[i];
    if (folded || !children.length) continue;
    order[i].top = children[0].top;
    order[i].bottom = children[children.length - 1].bottom;
    order[i].y = (children[0].y + children[children.length - 1].y) / 2;
  }
  return { rows, levels: order.length ? order[order.length - 1].depth + 1 : 1 };
}
