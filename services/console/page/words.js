// Numbers and names for people.

export const fixed = (number, digits = 2) => (number === null || number === undefined ? '–' : number.toFixed(digits));
export const percent = (number) => (number === null || number === undefined ? '–' : `${Math.round(100 * number)} %`);

export function count(number) {
  if (number >= 1e6) return `${(number / 1e6).toFixed(1)} M`;
  return number >= 1e4 ? `${(number / 1e3).toFixed(1)} k` : String(Math.round(number));
}

export function bytes(number) {
  if (number >= 1e6) return `${(number / 1e6).toFixed(1)} MB`;
  return number >= 1e3 ? `${(number / 1e3).toFixed(1)} kB` : `${Math.round(number)} B`;
}

export function actionName(task, action) {
  if (action === null || action === undefined || action < 0) return '';
  return task?.actions[action]?.name ?? `action ${action}`;
}

export const pathName = (task, path) => (path.length ? path.map((a) => actionName(task, a)).join(', ') : 'the scene as it is');

// A cause as the task puts it for people.
export const causeWords = (task, reason) => task?.causes[reason] ?? reason;

export const pathKey = (path) => path.join('-');
