// Draws what is in view of a tree, and nothing else: subtrees out of view are passed over whole, and
// those thinner than a pixel are one stroke.

import { colours, valueColour } from './colours.js';
import { actionName, fixed } from './words.js';

const kThumbAt = 26, kTextAt = 13, kEnoughVisits = 2;

function edge(paint, from, to, node) {
  const { context } = paint;
  const width = paint.onPlan.has(node) ? 3 : 0.6 + 5 * Math.sqrt(node.N / Math.max(1, paint.rootVisits));
  context.strokeStyle = paint.onPlan.has(node) ? colours().plan : valueColour(node.V);
  context.globalAlpha = node.mark === 'f' || node.mark === 'V' ? 0.45 : 1;
  context.lineWidth = width;
  context.beginPath();
  context.moveTo(from.sx, from.sy);
  const middle = (from.sx + to.sx) / 2;
  context.bezierCurveTo(middle, from.sy, middle, to.sy, to.sx, to.sy);
  context.stroke();
  context.globalAlpha = 1;
}

// A form of its own for each reason, so that no colour need tell them apart.
function mark(context, node, x, y, size) {
  if (node.mark === '') return;
  context.lineWidth = 2;
  context.beginPath();
  if (node.mark === 'f') {
    context.strokeStyle = colours().bad;
    context.moveTo(x - size, y - size);
    context.lineTo(x + size, y + size);
    context.moveTo(x + size, y - size);
    context.lineTo(x - size, y + size);
  } else if (node.mark === 'V') {
    context.strokeStyle = colours().bad;
    context.moveTo(x - size, y - size);
    context.lineTo(x, y + size);
    context.lineTo(x + size, y - size);
  } else {
    context.strokeStyle = colours().good;
    context.moveTo(x + size, y - size);
    context.lineTo(x + size, y + size);
  }
  context.stroke();
}

function body(paint, node, size) {
  const { context } = paint;
  const picture = size >= kThumbAt ? paint.picture(node) : null;
  const half = size / 2;
  if (picture) {
    context.imageSmoothingEnabled = false;
    context.drawImage(picture, node.sx - half, node.sy - half, size, size);
  } else {
    context.fillStyle = valueColour(node.V);
    context.beginPath();
    context.arc(node.sx, node.sy, Math.max(1.2, Math.min(half * 0.5, 6)), 0, 7);
    context.fill();
  }
  const framed = paint.onPlan.has(node) || node === paint.selected || node === paint.hovered || paint.found.has(node);
  if (picture || framed) {
    context.strokeStyle = node === paint.selected ? colours().accent : paint.onPlan.has(node) ? colours().plan : framed ? colours().ink : valueColour(node.V);
    context.lineWidth = framed ? 3 : 2;
    const r = picture ? half : Math.max(4, Math.min(half * 0.7, 9));
    context.strokeRect(node.sx - r, node.sy - r, 2 * r, 2 * r);
  }
  if (size >= 6) mark(context, node, node.sx, node.sy, Math.min(half * 0.7, 9));
  if (node.folded) {
    context.fillStyle = colours().soft;
    context.fillText('+', node.sx + half + 3, node.sy);
  }
}

// Values only where there are visits enough to mean something.
function words(paint, node, size, room) {
  const { context } = paint;
  const name = actionName(paint.task, node.action);
  const enough = node.N >= kEnoughVisits;
  const text = size >= kThumbAt && enough ? `${name}  ${fixed(node.score)}` : name;
  context.fillStyle = paint.onPlan.has(node) ? colours().plan : colours().ink;
  const leaf = node.folded || !node.children.length;
  if (leaf) {
    context.textAlign = 'left';
    context.fillText(text, node.sx + size / 2 + 5, node.sy, 2 * room);
  } else if (size >= kThumbAt) {
    context.textAlign = 'center';
    context.fillText(text, node.sx, node.sy + size / 2 + 8, room);
  }
}

// paint: {context, root, x, y (screen of level and row), row (pixels a row), level (pixels a level),
// width, height, onPlan, found, selected, hovered, rootVisits, task, picture(node)}. Returns the
// nodes that were drawn, with their places sx, sy.
export function paintTree(paint) {
  const { context, row, level, height, width } = paint;
  const size = Math.min(row * 0.82, level * 0.6, 120);
  const drawn = [];
  const open = [paint.root];
  while (open.length) {
    const node = open.pop();
    if (paint.y(node.bottom) < -row || paint.y(node.top) > height + row) continue;
    node.sx = paint.x(node.shownX ?? node.x);
    node.sy = paint.y(node.shownY ?? node.y);
    if (node.parent) edge(paint, node.parent, node, node);
    drawn.push(node);
    if (node.folded || node.sx - level > width) continue;
    // Thinner than a pixel and a half: one stroke stands for all that is below.
    if (node.bottom > node.top && (node.bottom - node.top) * row < 1.5) {
      const heir = node.children[0];
      heir.sx = paint.x(heir.x);
      heir.sy = node.sy;
      edge(paint, node, heir, heir);
      continue;
    }
    for (const child of node.children) open.push(child);
  }
  context.font = '12px system-ui, sans-serif';
  context.textBaseline = 'middle';
  for (const node of drawn) body(paint, node, size);
  if (row >= kTextAt) for (const node of drawn) if (node.parent) words(paint, node, size, level * 0.9);
  return { drawn, size };
}
