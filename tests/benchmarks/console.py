"""Behind console.sh."""
import json
import os
import statistics
import subprocess
import sys
import time

import browser
import deployment
import websocket

ROOT = sys.argv[1]
PAIRS = int(os.environ.get("PAIRS", 12))
SAMPLES = os.environ.get("SAMPLES", "1000")
WORKERS = os.environ.get("WORKERS", "8")
SEED = int(os.environ.get("SEED", 2000100))
SITE = ["--objects", "7", "--legs", "5"]  # 2,520 plans: each rollout has something to ask the networks for
STALLED = os.environ.get("STALLED") == "1"
IDLE_SECONDS = 20


def rollouts_per_second(folder, seed):
    """Of one search, nothing carried out."""
    out = os.path.join(folder, "measured")
    subprocess.run([deployment.program("prospect"), "explain", "--seed", str(seed), *SITE, "--samples", SAMPLES, "--workers", WORKERS,
                    "--rule", "best_first", "--refusal-threshold", "0", "--out", out, "--quiet"], check=False, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
        search = json.load(file)["searches"][0]
    return search["rollouts"] / search["seconds"]


def idle_share(console):
    before = console.cpu_seconds()
    time.sleep(IDLE_SECONDS)  # what is measured is time that passes
    return (console.cpu_seconds() - before) / IDLE_SECONDS


def looking(console):
    """Somebody who looks, until closed."""
    if STALLED:
        return websocket.WebSocket(console.port, receive_buffer=4096)
    page = browser.Browser()
    page.open(console.url)
    return page


def main():
    with deployment.deployment(*SITE, weights=os.path.join(ROOT, "model", "weights"), workers=int(WORKERS)) as folder:
        console = deployment.Console(folder, *deployment.console_arguments(folder))
        ratios = []
        share = None
        for pair in range(PAIRS):
            measured = {}
            for open_ in ((False, True) if pair % 2 == 0 else (True, False)):
                viewer = looking(console) if open_ else None
                measured[open_] = rollouts_per_second(folder, SEED + pair)
                if open_ and share is None:
                    share = idle_share(console)
                if viewer:
                    viewer.close()
            ratios.append(measured[True] / measured[False])
            print(f"pair {pair + 1}: {measured[False]:.0f} rollouts/s without, {measured[True]:.0f} with: {ratios[-1]:.3f}", flush=True)
        memory = console.memory_mb()
        console.stop()
    asked = 0.99 if STALLED else 0.95
    ratio = statistics.median(ratios)
    print(f"{'ok  ' if ratio >= asked else 'MISS'} median ratio {ratio:.3f} (at least {asked}); load {os.getloadavg()[0]:.1f}")
    print(f"{'ok  ' if share < 0.05 else 'MISS'} console while nothing moves: {100 * share:.1f} % of a core (below 5); {memory:.0f} MB")
    sys.exit(0 if ratio >= asked and share < 0.05 else 5)


main()
