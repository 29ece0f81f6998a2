// What stands for what: V from dark blue to yellow (cividis, the same for any colour vision). On a
// dark ground the darkest part is left out.

const dark = matchMedia('(prefers-color-scheme: dark)');
let palette = null;

function read() {
  const style = getComputedStyle(document.documentElement);
  const of = (name) => style.getPropertyValue(name).trim();
  palette = { ground: of('--ground'), sheet: of('--sheet'), ink: of('--ink'), soft: of('--soft'), edge: of('--edge'), accent: of('--accent'), plan: of('--plan'), bad: of('--bad'), good: of('--good') };
}

dark.addEventListener('change', read);

export function colours() {
  if (!palette) read();
  return palette;
}

const kSteps = 64;
const tables = {};

export function valueColour(value) {
  if (value === null) return colours().edge;
  const least = dark.matches ? 0.25 : 0;
  tables[least] ??= d3.range(kSteps + 1).map((i) => d3.interpolateCividis(least + (i / kSteps) * (1 - least)));
  return tables[least][Math.round(kSteps * Math.min(1, Math.max(0, value)))];
}
