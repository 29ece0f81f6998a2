#!/usr/bin/env python3
"""Makes the pictures of docs/console.md, with the bundled networks, in a private bus:

  tests/integration/with_bus.sh /usr/bin/python3 tests/integration/console/screenshots.py BIN DOCS
"""
import os
import sys
import time

sys.dont_write_bytecode = True
os.environ["PROSPECT_TEST_BIN"] = sys.argv[1]
import browser
import deployment
from deployment import until

DOCS = sys.argv[2]
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
WEIGHTS = os.path.join(ROOT, "model", "weights")
SOLVED, HOPELESS = 2000002, 2000103


def save(page, name):
    page.screenshot(os.path.join(DOCS, f"console-{name}.png"))


def run(page, seed, samples):
    until(lambda: page.js("return !document.getElementById('run').disabled"), "a button that can be pressed")
    page.js("document.querySelector('[name=seed]').value = arguments[0]; document.querySelector('[name=samples]').value = arguments[1]", seed, samples)
    page.click("run")
    until(lambda: page.js("return prospect.known.facts.run?.running"), "a run")
    until(lambda: page.js("return !prospect.known.facts.run.running"), "its end", 180)


def pick(page, index):
    """The search with this place in the list, the first 0."""
    page.js("""const pick = document.getElementById('search-pick');
pick.value = prospect.known.state.episode.searches[arguments[0]];
pick.dispatchEvent(new Event('change'));""", index)
    until(lambda: page.js("return prospect.tree.meta?.id === prospect.known.state.episode.searches[arguments[0]]", index), "a search")


def settle(page):
    """Until no picture has come for a while."""
    last = [None, time.monotonic()]

    def quiet():
        count = page.js("return prospect.pictures.kept.size")
        if count != last[0]:
            last[:] = [count, time.monotonic()]
        return time.monotonic() - last[1] > 2
    until(quiet, "pictures that have come")


def episode(page):
    run(page, SOLVED, 60)
    settle(page)
    pick(page, 0)
    settle(page)
    save(page, "episode")


def tree(page):
    run(page, HOPELESS, 400)
    pick(page, 0)
    page.click("fit-plan")
    settle(page)
    page.click("tab-refusal")
    settle(page)
    save(page, "refusal")
    page.click("tab-node")
    page.js("const t = prospect.tree; prospect.treeView.select([...t.root.children].sort((a, b) => b.N - a.N)[0]); prospect.treeView.fit('all')")
    settle(page)
    save(page, "tree")


def what_if(page):
    page.js("const t = prospect.tree; prospect.treeView.select([...t.root.children].sort((a, b) => b.N - a.N)[0])")
    page.click("tab-whatif")
    page.js("""const best = prospect.tree.meta.best.path;
[...document.querySelectorAll('#panel-node button')][0].click();""")
    settle(page)
    save(page, "whatif")


def main():
    with deployment.deployment(task="stacking", weights=WEIGHTS) as folder:
        console = deployment.Console(folder, *deployment.console_arguments(folder), "--control")
        try:
            with browser.Browser(1120, 960) as page:
                page.open(console.url)
                episode(page)
                tree(page)
                what_if(page)
            with browser.Browser(1120, 960, dark=True) as page:
                page.open(console.url)
                until(lambda: page.js("return window.prospect?.known.bus?.servers.length"), "the bus")
                page.click("tab-bus")
                settle(page)
                save(page, "bus")
        finally:
            console.stop()


main()
