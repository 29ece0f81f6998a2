// What the camera sees, and what is happening, in words.

import { by, setText, terms } from './dom.js';
import { show, toCanvas } from './pictures.js';
import { actionName, causeWords, fixed, pathName } from './words.js';

const kWords = { nobody: 'nobody is there', idle: 'waiting', thinking: 'thinking', acting: 'acting', deciding: 'deciding', refused: 'refused', solved: 'solved', failed: 'failed', stopped: 'stopped', done: 'done' };
const kKinds = { thinking: 'busy', acting: 'busy', deciding: 'busy', solved: 'good', done: 'good', refused: 'bad', failed: 'bad', stopped: 'bad' };

export function showCamera(header, bytes) {
  show(by('camera'), toCanvas(header.w, header.h, bytes));
  by('camera').dataset.frame = header.frame;
}

export function showHappening(happening) {
  setText(by('happening'), kWords[happening] ?? happening);
  by('happening').dataset.kind = kKinds[happening] ?? 'idle';
  by('happening').dataset.state = happening;
}

// Why it stands as it does, in one line.
function why({ task, episode, happening }) {
  const { plan, status } = episode;
  if (happening === 'acting') return actionName(task, status.action);
  if (plan?.refused) return plan.reason;
  const last = episode.acts.at(-1);
  if (last && last.state === 'failed') return `${actionName(task, last.action)}: ${causeWords(task, last.reason)}`;
  if (status?.state === 'refused') return status.reason;
  return '';
}

export function showScene(state, meta) {
  const { task, episode } = state;
  setText(by('task'), task ? task.name : '');
  setText(by('why'), why(state));
  if (!task) return;
  const { status, plan } = episode;
  const goals = meta?.goals ?? [];
  const rows = [
    ['Goal', goals.length ? goals.join(', ') : "the task's own"],
    ['Done', `${episode.acts.filter((act) => act.state === 'succeeded').length} of ${meta?.plan_length ?? task.plan_length} actions`],
    ['Now', status?.state === 'running' ? actionName(task, status.action) : 'nothing moves'],
    ['Time', status ? `${fixed(status.seconds, 1)} s; an action has ${fixed(task.limit_s, 0)} s` : '–'],
  ];
  if (plan) rows.push(['Plan', `${pathName(task, plan.steps.map((step) => step.action))}; score ${fixed(plan.score)}`]);
  if (episode.id !== '-1') rows.push(['Frame', `${episode.frame}`]);
  if (state.dropped_searches) rows.push(['Memory', `${state.dropped_searches} oldest searches were dropped`]);
  terms(by('facts'), rows);
}
