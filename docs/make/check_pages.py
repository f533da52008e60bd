"""Look at every page of the built manual in a browser: `python docs/make/check_pages.py FOLDER`.

Each must set its formulas without an error, fit into a wide and a narrow window, ask no other host
for anything, and leave no error in the console. Needs Playwright and Debian's chromium.
"""

import sys
from collections.abc import Iterator
from pathlib import Path
from shutil import which
from typing import Any

from playwright.sync_api import sync_playwright

WIDTHS = (1280, 400)
SOURCES = {"_modules", "_static", "explore"}  # the last has tests of its own
SET = "window.MathJax && MathJax.startup ? MathJax.startup.promise.then(() => true) : true"
FOUND = """() => ({
  wider: document.documentElement.scrollWidth - document.documentElement.clientWidth,
  wrong: document.querySelectorAll('[data-mjx-error]').length,
  unset: document.querySelectorAll('.math').length
    - document.querySelectorAll('.math mjx-container').length,
  cut: [...document.querySelectorAll('div.math mjx-container')].filter(formula =>
    formula.getBoundingClientRect().left < formula.parentNode.getBoundingClientRect().left - 1
  ).length,
  over: Math.max(0, ...[...document.querySelectorAll('.bd-article, .bd-content')].map(part =>
    part.scrollWidth - part.clientWidth)),
})"""


def faults(page: Any, file: Path, said: list[str]) -> Iterator[str]:
    """Yield what is wrong with a page."""
    said.clear()
    page.goto(file.as_uri())
    page.evaluate(SET)
    found = page.evaluate(FOUND)
    if found["wider"] > 1:
        yield f"{found['wider']} pixels wider than its window"
    if found["wrong"] or found["unset"] > 0:
        yield f"formulas: {found['wrong']} wrong, {found['unset']} not set"
    if found["cut"]:
        yield f"{found['cut']} formulas begin left of where they can be seen"
    if found["over"] > 1:
        yield f"its text is {found['over']} pixels wider than its place"
    yield from said


def listen(page: Any, said: list[str]) -> None:
    """Keep errors of the console and requests to other hosts."""

    def ask(request: Any) -> None:
        if not request.url.startswith(("file:", "data:", "blob:")):
            said.append(f"asks {request.url}")

    page.on("request", ask)
    page.on("requestfailed", lambda request: said.append(f"does not get {request.url}"))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("console", lambda line: said.append(line.text) if line.type == "error" else None)


def main(folder: Path) -> int:
    """Return 1 if a page has a fault; say which."""
    files = [page for page in sorted(folder.rglob("*.html")) if not SOURCES & set(page.parts)]
    bad = 0
    with sync_playwright() as tool:
        browser = tool.chromium.launch(executable_path=which("chromium"), args=["--no-sandbox"])
        for width in WIDTHS:
            page, said = browser.new_page(viewport={"width": width, "height": 900}), []
            listen(page, said)
            for file in files:
                for fault in faults(page, file, said):
                    bad += 1
                    print(f"{file.relative_to(folder)}, {width} pixels wide: {fault}")
    print(f"{len(files)} pages, {bad} faults")
    return int(bad > 0 or not files)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
