// Who is on the bus, how the model servers fare, and what goes over it.

import { by, el, table } from './dom.js';
import { bytes, count, fixed } from './words.js';

const kHistory = 120;

// Evaluations a second over the last minute.
function plotRate(svg, values) {
  const width = 300, height = 80;
  const x = d3.scaleLinear().domain([0, kHistory - 1]).range([0, width]);
  const y = d3.scaleLinear().domain([0, Math.max(10, d3.max(values))]).range([height - 2, 12]);
  const line = d3.line().x((_, i) => x(kHistory - values.length + i)).y((v) => y(v));
  svg.attr('viewBox', `0 0 ${width} ${height}`);
  svg.selectAll('path').data([values]).join('path').attr('d', line);
  svg.selectAll('text').data([d3.max(values) ?? 0]).join('text').attr('x', 2).attr('y', 9).text((v) => `evaluations a second, at most ${count(v)}`);
}

// How many batches had how many rows.
function plotBatches(svg, bins) {
  const width = 300, height = 80;
  const x = d3.scaleBand().domain(d3.range(bins.length)).range([0, width]).padding(0.1);
  const y = d3.scaleLinear().domain([0, Math.max(1, d3.max(bins) ?? 1)]).range([0, height - 24]);
  svg.attr('viewBox', `0 0 ${width} ${height}`);
  svg.selectAll('rect').data(bins).join('rect').attr('x', (_, i) => x(i)).attr('width', x.bandwidth()).attr('y', (v) => height - 12 - y(v)).attr('height', (v) => y(v));
  svg.selectAll('text').data([`batches of 1 to ${bins.length} rows`]).join('text').attr('x', 2).attr('y', height - 2).text((t) => t);
}

export class BusView {
  constructor(say) {
    this.rates = [];
    this.slider = el('input', { type: 'range', min: 0, max: 16, step: 1, id: 'workers', 'aria-label': 'planner workers', onchange: () => say({ t: 'scale', workers: Number(this.slider.value) }), oninput: () => this.tellWish() });
    this.wish = el('output', { for: 'workers' });
    this.sliderWords = el('p', { class: 'soft', role: 'status' });
    this.workers = el('div', { id: 'workers-place' }, el('label', {}, 'Workers ', this.slider, this.wish), this.sliderWords);
    this.rate = el('div', {});
    this.batches = el('div', {});
    this.services = el('div', {});
    this.channels = el('div', {});
    by('panel-bus').append(this.workers, el('h2', {}, 'Model servers'), this.rate, this.batches, el('h2', {}, 'Services'), this.services, el('h2', {}, 'Channels'), this.channels);
    this.rateSvg = d3.select(this.rate).append('svg').attr('class', 'plot').attr('role', 'img').attr('aria-label', 'evaluations a second');
    this.batchSvg = d3.select(this.batches).append('svg').attr('class', 'plot').attr('role', 'img').attr('aria-label', 'sizes of batches');
    this.rateWords = this.rate.appendChild(el('p', { class: 'soft' }));
  }

  tellWish() {
    this.wish.textContent = ` ${this.slider.value}`;
  }

  // Slider and services by what HEALTH says; names and restarts by what the supervisor does.
  update(bus, facts) {
    if (!bus) return;
    const busy = document.activeElement === this.slider;
    if (!busy) this.slider.value = bus.workers;
    this.tellWish();
    const why = facts?.may?.scale ?? 'a recording';
    this.slider.disabled = why !== '';
    this.sliderWords.textContent = facts?.scale?.running ? 'starting and stopping …' : why || facts?.scale?.words || '';
    this.rates.push(d3.sum(bus.servers, (server) => server.per_second));
    if (this.rates.length > kHistory) this.rates.shift();
    plotRate(this.rateSvg, this.rates);
    plotBatches(this.batchSvg, bus.servers[0]?.batches ?? []);
    this.rateWords.textContent = bus.servers.map((s) => `${s.engine}: ${count(s.evaluations)} evaluations, ${fixed(s.batch_ms, 1)} ms a batch, ${s.queue} waiting`).join('; ') || 'none is heard';
    this.listServices(bus, facts);
    this.channels.replaceChildren(table(['channel', '/s', 'B/s', 'refused'], bus.channels.map((c) => [c.name, fixed(c.per_second, 1), bytes(c.bytes_per_second), this.refused(c)])));
  }

  listServices(bus, facts) {
    const kept = new Map((facts?.supervised ?? []).map((s) => [s.pid, s]));
    const rows = bus.services.map((s) => {
      const state = el('span', { class: s.alive && s.state !== 'fault' ? 'good' : 'bad', title: s.note }, s.state === 'fault' ? `fault: ${s.note}` : s.state);
      return [kept.get(s.pid)?.name ?? s.service, state, s.queue, fixed(s.cpu_s, 0), fixed(s.rss_mb, 0), kept.get(s.pid)?.restarts ?? '–'];
    });
    for (const s of facts?.supervised ?? []) {
      if (s.state === 'given_up') rows.push([s.name, el('span', { class: 'bad' }, `given up: ${s.last_words}`), '', '', '', s.restarts]);
    }
    this.services.replaceChildren(table(['service', 'state', 'queue', 'cpu s', 'MB', 'restarts'], rows));
  }

  refused(channel) {
    const reasons = Object.entries(channel.refused);
    return reasons.length ? el('span', { class: 'bad' }, reasons.map(([reason, n]) => `${n} ${reason}`).join(', ')) : '0';
  }
}
