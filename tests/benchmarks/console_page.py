"""Behind console_page.sh."""
import os
import statistics
import sys

import browser
import deployment
import stopping
from deployment import until

SEED = 2000000
PRESSES = 20
# A tree of a given size whose nodes all have four children, all of it in view, drawn again and again.
DRAW = """const [count] = arguments;
const { tree, treeView } = prospect;
tree.clear('made');
const rows = [[0, -1, -1, count, 0.5, 0.9, 0.5, 1, null, null, 0.5, '', 0]];
for (let id = 1; id < count; id += 1) rows.push([id, Math.floor((id - 1) / 4), (id - 1) % 4, 1 + count / id, 0.5, 0.5, (id % 97) / 97, 0.9, 0.5, 0.5, 0.4, '', 0]);
tree.take(rows);
treeView.reset();
treeView.relay(true);
treeView.fit('all');
treeView.frames.length = 0;
window.moving = setInterval(() => treeView.touch(), 10);"""


def latency(page):
    """Milliseconds from a message on the bus to the page that shows it, of four episodes."""
    page.js("prospect.latencies.length = 0")
    for seed in range(SEED, SEED + 4):
        until(lambda: page.js("return !document.getElementById('run').disabled"), "a button that can be pressed")
        for name, value in (("seed", seed), ("samples", 100), ("threshold", 0)):
            page.js("document.querySelector(`[name=${arguments[0]}]`).value = arguments[1]", name, value)
        page.click("run")
        until(lambda: page.js("const run = prospect.known.facts.run; return run?.running"), "an episode")
        until(lambda: page.js("return !prospect.known.facts.run.running"), "its end", 120)
    return page.js("return [...prospect.latencies]")


def frames(page, nodes):
    """Milliseconds of drawing a frame, and how many nodes were in view."""
    page.js(DRAW, nodes)
    until(lambda: page.js("return prospect.treeView.frames.length") >= 60, "60 frames")
    page.js("clearInterval(window.moving)")
    return statistics.median(page.js("return prospect.treeView.frames")), page.js("return prospect.treeView.drawn.length")


def row(name, value, unit, most):
    print(f"{'ok  ' if value <= most else 'MISS'} {name}: {value:.1f} {unit} (at most {most:.0f})", flush=True)
    return value <= most


def main():
    with deployment.deployment() as folder:
        console = deployment.Console(folder, *deployment.console_arguments(folder), "--control")
        with browser.Browser() as page:
            page.open(console.url)
            until(lambda: page.js("return window.prospect?.known.state?.task"), "a task on the page")
            delays = latency(page)
            good = row(f"message to screen, median of {len(delays)}", statistics.median(delays), "ms", 150)
            for nodes, most in ((2000, 1000 / 30), (50000, 100)):
                median, drawn = frames(page, nodes)
                good &= row(f"a frame of {nodes} nodes, {drawn} in view", median, "ms", most)
        console.stop()
    with stopping.moving_table(sys.argv[1:]) as (console, _):
        presses = [stopping.press_to_cancel_ms(console) for _ in range(PRESSES)]
    good &= row(f"press of stop to CANCEL on the bus, longest of {PRESSES}", max(presses), "ms", 100)
    print(f"load {os.getloadavg()[0]:.1f}")
    sys.exit(0 if good else 5)


main()
