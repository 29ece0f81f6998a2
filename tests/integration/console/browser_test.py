#!/usr/bin/env python3
"""The console in a real browser, on a deployment with the scripted engine. Without Chromium and Selenium it is skipped (77).

  browser_test.py BIN
"""
import os
import signal
import subprocess
import sys
import time
import unittest

sys.dont_write_bytecode = True
os.environ["PROSPECT_TEST_BIN"] = sys.argv[1]
import browser
import deployment
import recording
from deployment import program, until

SEED = 2000000
SLOWLY = "channel=EXPAND_REPLY,delay=300ms"  # so that a search can be met half-way
STATE = "return document.getElementById('happening').dataset.state"
# The tree as it is shown: N and V of each path, for comparing one page with another.
TREE = """const tree = prospect.tree;
return tree.nodes.filter((node) => node?.known).map((node) => [tree.pathOf(node).join('-'), node.N, node.V]).sort();"""


def run(page, seed=SEED, samples=200, threshold=0, task_done=("solved", "failed", "stopped", "refused")):
    """An episode by its button. @return its outcome as the page says it"""
    start(page, seed, samples, threshold)
    return until(lambda: page.js(STATE) in task_done and ended(page) and page.js(STATE), "the episode's outcome", 120)


def start(page, seed, samples, threshold):
    until(lambda: page.js("return !document.getElementById('run').disabled"), "a button that can be pressed")
    for name, value in (("seed", seed), ("samples", samples), ("threshold", threshold)):
        page.js("document.querySelector(`[name=${arguments[0]}]`).value = arguments[1]", name, value)
    page.click("run")


def ended(page):
    return page.js("return prospect.known.facts.run && !prospect.known.facts.run.running")


def open_page(page, url):
    page.open(url)
    until(lambda: page.js("return window.prospect?.known.state?.task"), "a task on the page")


class ConsoleInABrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.up = deployment.deployment("--chaos", SLOWLY)
        cls.folder = cls.up.__enter__()
        cls.console = deployment.Console(cls.folder, *deployment.console_arguments(cls.folder), "--control")
        cls.page = browser.Browser()
        open_page(cls.page, cls.console.url)

    @classmethod
    def tearDownClass(cls):
        cls.page.close()
        cls.console.stop()
        cls.up.__exit__(None, None, None)

    def check_strip(self, page, result):
        """What the page shows of an episode is what its result.json says."""
        acts = page.js("return prospect.known.state.episode.acts")
        names = page.js("return prospect.known.state.task.actions.map((action) => action.name)")
        self.assertEqual([(names[act["action"]], act["state"]) for act in acts],
                         [(act["name"], act["observed"]) for act in result["acts"]])
        shown = page.js("return [...document.querySelectorAll('.strip .step')].map((step) => step.textContent)")
        for act in result["acts"]:
            self.assertIn(act["name"], shown)

    def test_1_an_episode_by_its_button_agrees_with_its_result(self):
        outcome = run(self.page)
        result = deployment.result_of(self.folder, SEED)
        self.assertEqual(outcome, result["outcome"])
        self.check_strip(self.page, result)
        searches = self.page.js("return prospect.known.state.episode.searches")
        self.assertEqual(len(searches), len(result["searches"]))
        # Every search that was made can be opened again, with its nodes.
        first = searches[0]
        self.page.js("const pick = document.getElementById('search-pick'); pick.value = arguments[0]; pick.dispatchEvent(new Event('change'))", first)
        until(lambda: self.page.js("return prospect.tree.meta?.id") == first, "the first search")
        best = self.page.js("return prospect.tree.meta.best.path.map((a) => prospect.actionName(prospect.known.state.task, a))")
        self.assertEqual(best, result["searches"][0]["plan"])
        nodes = self.page.js("return prospect.tree.meta.nodes")
        until(lambda: self.page.js("return prospect.tree.nodes.filter((n) => n?.known).length") == nodes, f"all {nodes} nodes")
        self.page.js("const pick = document.getElementById('search-pick'); pick.value = ''; pick.dispatchEvent(new Event('change'))")
        self.assertEqual(self.page.complaints(), [])

    def test_2_a_reload_and_a_second_browser_show_the_same_tree(self):
        start(self.page, SEED, 100000, 0)
        until(lambda: self.page.js("return prospect.tree.size >= 2 && prospect.tree.meta?.running"), "a tree that grows")
        self.page.driver.refresh()
        with browser.Browser() as second:
            open_page(second, self.console.url)
            until(lambda: self.page.js("return window.prospect?.tree.size >= 2"), "the tree again")
            until(lambda: second.js("return prospect.tree.size >= 2"), "the tree in both")
            until(lambda: ended(self.page) and ended(second), "the end of the episode", 120)
            until(lambda: self.page.js(TREE) == second.js(TREE), "two browsers that show the same")
            self.page.driver.refresh()
            until(lambda: self.page.js("return window.prospect?.tree.size >= 2"), "the tree after another reload")
            until(lambda: self.page.js(TREE) == second.js(TREE), "the same tree after a reload")

    def test_3_stop_cancels_the_action(self):
        # An action may be over before a test has looked: the page itself presses the button.
        self.page.js("""const place = document.getElementById('happening');
new MutationObserver((_, observer) => {
  if (place.dataset.state !== 'acting') return;
  observer.disconnect();
  document.getElementById('stop').click();
}).observe(place, { attributes: true });""")
        start(self.page, SEED, 50, 0)
        until(lambda: self.page.js("return prospect.known.facts.run.running"), "a run")
        until(lambda: ended(self.page), "an end")
        acts = self.page.js("return prospect.known.state.episode.acts")
        self.assertIn(acts[-1]["state"], ("cancelled", "succeeded", "failed"))
        self.assertEqual(self.page.js("return prospect.known.facts.run.exit"), 130)

    def test_4_the_console_killed_and_started_again(self):
        self.console.stop(signal.SIGKILL)
        until(lambda: "lost" in self.page.text("connection"), "a page that says so")
        self.console.start(str(self.console.port))
        until(lambda: self.page.text("connection").startswith("connected"), "a page that recovers by itself")
        until(lambda: self.page.js(STATE) != "connection lost", "a state")
        run(self.page, seed=SEED + 2, samples=50)

    def test_5_a_recording_shows_the_same_plan(self):
        log = os.path.join(self.folder, "episode.lcmlog")
        with subprocess.Popen(["lcm-logger", "-q", log]) as logger:
            until(lambda: os.path.exists(log), "a log")
            run(self.page, seed=SEED + 3, samples=50)
            time.sleep(0.5)  # what was said last is heard
            logger.send_signal(signal.SIGINT)
        player = deployment.Console(self.folder, "--log", log)
        try:
            with browser.Browser() as page:
                open_page(page, player.url)
                page.js("document.querySelector('#timeline select').value = '10'; document.querySelector('#timeline select').dispatchEvent(new Event('change'))")
                until(lambda: page.js("const f = prospect.known.facts; return f.at_us === f.length_us && !f.reading"), "the end of the recording", 120)
                result = deployment.result_of(self.folder, SEED + 3)
                until(lambda: page.js(STATE) == result["outcome"], "the outcome")
                self.check_strip(page, result)
                self.assertTrue(page.js("return document.getElementById('buttons').hidden"), "no buttons for a recording")
        finally:
            player.stop()

    def test_6_names_of_the_bus_never_become_markup(self):
        log = os.path.join(self.folder, "evil.lcmlog")
        recording.write(log)
        player = deployment.Console(self.folder, "--log", log)
        try:
            with browser.Browser() as page:
                open_page(page, player.url)
                until(lambda: page.js("const f = prospect.known.facts; return f.at_us === f.length_us && !f.reading"), "the end")
                until(lambda: page.js("return prospect.known.state.episode.acts.length"), "an action")
                for tab in ("tab-node", "tab-whatif", "tab-refusal", "tab-bus"):
                    page.click(tab)
                shown = page.js("return document.body.textContent")
                self.assertGreater(shown.count(recording.EVIL), 3, "names are shown as they are")
                self.assertIsNone(page.js("return window.harmed ?? null"))
                self.assertEqual(page.js("return document.querySelectorAll('body img, body script').length"), 0)
                self.assertEqual(page.complaints(), [])
        finally:
            player.stop()


if __name__ == "__main__":
    if not browser.there():
        print("no Chromium with its driver, or no Selenium")
        sys.exit(browser.SKIP)
    unittest.main(argv=sys.argv[:1])
