"""How long the page takes in a browser: its first answer, one more, a frame of its film.

python benchmarks/explorer_browser.py            also with the processor slowed down four times
python benchmarks/explorer_browser.py --smoke    a quick pass through the same code

Needs Playwright and Debian's chromium.
"""

import argparse
import json
import shutil
import subprocess
import sys
import time
from typing import Any

import numpy as np
from explorer import BODIES, moved
from playwright.sync_api import sync_playwright

COMMAND = [sys.executable, "-c", "from carom.cli import run; run()", "explore"]
OPTIONS = ["--no-open", "--port", "0", "--json"]
STATE = "?angle=25&friction=0.25&law=mindlin"
SIZE = {"width": 1440, "height": 900}
SHOWN = "#results tr"  # of an impact
SEED = 20261127
KINDS = {
    "bodies": BODIES,
    "numbers": {"given": "numbers"},
    "bodies with losses": BODIES | {"restitution": 0.8},
    "a plate": BODIES | {"thickness": 10.0},
}
ANSWERS = """async queries => {
  const cost = [];
  for (const query of queries) {
    const start = performance.now();
    await Carom.reading.answer(query);
    cost.push(performance.now() - start);
  }
  return cost;
}"""
FRAMES = """async count => {
  const found = { cost: [], apart: [] };
  let before = 0;
  Carom.clock.pause();
  for (let i = 0; i < count; i++) {
    const now = await new Promise(requestAnimationFrame);
    if (before) found.apart.push(now - before);
    before = now;
    const start = performance.now();
    Carom.page.frame(i / count);
    found.cost.push(performance.now() - start);
  }
  return found;
}"""


def first_answer(browser: Any) -> tuple[float, Any, subprocess.Popen[str]]:
    """Return the seconds from the command until the page shows an impact, and both."""
    start = time.perf_counter()
    program = subprocess.Popen([*COMMAND, *OPTIONS], stdout=subprocess.PIPE, text=True)
    assert program.stdout is not None
    address = json.loads(program.stdout.readline())["url"]
    tab = browser.new_page(viewport=SIZE)
    tab.goto(address + STATE, wait_until="commit")
    tab.wait_for_selector(SHOWN, state="attached", timeout=600_000)
    return time.perf_counter() - start, tab, program


def answers(tab: Any, kind: str, count: int) -> str:
    """Return what answers to a kind of view cost, its sliders somewhere else each time."""
    random = np.random.default_rng(SEED)
    queries = [moved(KINDS[kind], (), False, random) for _ in range(count)]
    middle, most = np.percentile(tab.evaluate(ANSWERS, queries), [50, 95])
    return f"{middle:.1f} ms, 95 % within {most:.1f} ms"


def frames(tab: Any, slowed: int, count: int) -> str:
    """Return what frames cost, with the processor slowed down so many times."""
    line = tab.context.new_cdp_session(tab)
    line.send("Emulation.setCPUThrottlingRate", {"rate": slowed})
    found = tab.evaluate(FRAMES, count)
    middle, most = np.percentile(found["cost"], [50, 95])
    rate = 1e3 / np.median(found["apart"])
    return f"{middle:.1f} ms, 95 % within {most:.1f} ms; {rate:.0f} frames a second"


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    smoke = parser.parse_args().smoke
    starts, count = (1, 20) if smoke else (5, 240)
    chromium = shutil.which("chromium")
    if not chromium:
        print("SKIPPED: there is no chromium")
        return
    with sync_playwright() as drive:
        browser = drive.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        times = []
        for _ in range(starts):
            seconds, tab, program = first_answer(browser)
            times.append(seconds)
            if len(times) == starts:
                for kind in KINDS:
                    print(f"an answer, {kind}: {answers(tab, kind, count)}")
                for slowed in (1, 4):
                    told = frames(tab, slowed, count)
                    print(f"a frame of the film, processor slowed down {slowed} times: {told}")
            tab.close()
            program.terminate()
            program.wait()
        typical, most = np.median(times), max(times)
        print(f"from the command to the first answer: {typical:.2f} s, at most {most:.2f} s")
        browser.close()


if __name__ == "__main__":
    main()
