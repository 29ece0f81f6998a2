// The page: what comes from the console goes to the views, and what a person does goes back.

import { BusView } from './bus_view.js';
import { Connection } from './connection.js';
import { by, el, setText } from './dom.js';
import { Hand } from './hand.js';
import { NodePanel } from './node_panel.js';
import { Pictures, toCanvas } from './pictures.js';
import { Refusal } from './refusal.js';
import { showCamera, showHappening, showScene } from './scene.js';
import { Strip } from './strip.js';
import { setUpTabs } from './tabs.js';
import { Timeline } from './timeline.js';
import { TreeData } from './tree_data.js';
import { TreeView } from './tree_view.js';
import { WhatIf } from './what_if.js';
import { actionName, count, fixed } from './words.js';

const kLatencies = 500;

const known = { facts: null, state: null, bus: null };
const latencies = [];
let connection = null;
let repaint = false;

const say = (request) => connection?.say(request);
const tree = new TreeData();
const pictures = new Pictures(say, () => { repaint = true; });
const strip = new Strip(pictures);
const nodePanel = new NodePanel(tree, pictures, { say, whatIf });
const whatIfPanel = new WhatIf(tree, pictures, say);
const refusal = new Refusal(pictures);
const busView = new BusView(say);
const hand = new Hand(say);
const timeline = new Timeline(say);
const treeView = new TreeView(tree, pictures, {
  select: (node) => nodePanel.show(known.state?.task, node, true),
  hover: (node) => node && nodePanel.show(known.state?.task, node),
});
const openTab = setUpTabs(document.querySelector('[role="tablist"]'), (id) => {
  if (id === 'tab-whatif') whatIfPanel.update();
  repaint = true;
});

function whatIf(path) {
  whatIfPanel.open(path);
  openTab('tab-whatif');
}

function takeSearch(message) {
  const { rows, search, of } = message;
  if (search === null) {
    tree.clear(null);
    treeView.reset();
  }
  const id = search?.id ?? of;
  if (id && (message.fresh || id !== tree.search)) {
    tree.clear(id);
    treeView.reset();
    nodePanel.show(null, null);
    whatIfPanel.reset();
  }
  if (rows) tree.take(rows);
  if (search) {
    tree.meta = search;
    refusal.update(known.state?.task, tree);
  }
  if (!rows && !search) return;
  treeView.changed();
  if (nodePanel.node) nodePanel.show(known.state?.task, nodePanel.node);
  if (!by('panel-whatif').hidden) whatIfPanel.update();
}

function takeState(state) {
  const task = JSON.stringify(state.task);
  known.state = state;
  treeView.task = state.task;
  if (task !== known.task) {
    known.task = task;
    whatIfPanel.setTask(state.task);
  }
  listSearches(state);
  if (state.happening === 'refused' && known.happening !== 'refused') openTab('tab-refusal');
  known.happening = state.happening;
}

function listSearches(state) {
  const pick = by('search-pick');
  const names = state.searches.map((search, i) => [search.id, `${i + 1 + state.dropped_searches}. after ${search.executed} actions, ${count(search.nodes)} nodes`]);
  const options = [['', 'the latest'], ...names.reverse()];
  if (JSON.stringify(options) === known.options) return;
  known.options = JSON.stringify(options);
  const chosen = pick.value;
  pick.replaceChildren(...options.map(([id, name]) => el('option', { value: id, selected: id === chosen }, name)));
}

function noteLatency(message) {
  if (!message.oldest || known.facts?.kind !== 'bus') return;
  latencies.push(Date.now() - message.oldest / 1000);
  if (latencies.length > kLatencies) latencies.shift();
}

const takers = {
  data(message) {
    if (message.state) takeState(message.state);
    showHappening(message.happening);
    takeSearch(message);
    if (message.state || message.search) showScene(known.state, tree.meta);
    if (message.state) strip.update(known.state);
    if (message.bus) {
      known.bus = message.bus;
      busView.update(known.bus, known.facts);
    }
    if (message.missed) known.missed = message.missed;
    noteLatency(message);
  },
  picture(header, bytes) {
    if (header.k === 'camera') showCamera(header, bytes);
    else if (header.k === 'seen') strip.takeSeen(header, toCanvas(header.w, header.h, bytes));
    else pictures.put(header.search, header.path === '' ? [] : header.path.split('-').map(Number), toCanvas(header.w, header.h, bytes));
    repaint = true;
  },
  facts(message) {
    known.facts = message.facts;
    hand.update(known.facts);
    timeline.update(known.facts);
    busView.update(known.bus, known.facts);
  },
  choices: (message) => nodePanel.takeChoices(message),
  wrong(message) {
    if (message.of === 'judge') whatIfPanel.wrong(message.words);
    else hand.wrong(message.words);
  },
  state(words, lost) {
    known.connection = words;
    by('connection').classList.toggle('lost', lost);
    if (lost) showHappening('connection lost');
    if (!lost) pictures.forgetAsked();
    const watched = by('search-pick').value;
    if (!lost && watched) say({ t: 'watch', search: watched });
    tellConnection();
  },
};

function tellConnection() {
  if (known.connection === undefined) return;
  const { missed } = known;
  const late = latencies.length ? `, ${fixed(d3.median(latencies), 0)} ms behind the bus` : '';
  const lost = missed ? `${count(missed.pictures)} camera pictures left out (10 a second are shown)${missed.stalled_s ? `, stalled for ${fixed(missed.stalled_s, 1)} s` : ''}` : '';
  if (missed?.stalled_s) known.connection = `connected; this page had stalled for ${fixed(missed.stalled_s, 1)} s`;
  setText(by('connection'), known.connection + late);
  by('connection').title = lost;
}

by('search-pick').onchange = (event) => say({ t: 'watch', search: event.target.value || null });

setInterval(tellConnection, 500);

// Pictures come one by one; what shows them is painted once for all that came, less often while the search has use for the processors.
const kPaintEvery = 80, kWhileThinking = 240;
let paintedAt = 0;
setInterval(() => {
  if (!repaint || (tree.meta?.running && performance.now() - paintedAt < kWhileThinking)) return;
  paintedAt = performance.now();
  repaint = false;
  treeView.touch();
  strip.update(known.state);
  refusal.paint();
  whatIfPanel.paint();
}, kPaintEvery);

connection = new Connection(takers);
// For tests, and for the curious.
window.prospect = { known, tree, treeView, latencies, pictures, actionName };
