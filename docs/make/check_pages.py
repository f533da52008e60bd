"""Look at every page of the built manual in a browser: `python docs/make/check_pages.py FOLDER`.

Each must set its formulas without an error, fit into a wide and a narrow window, ask no other host
for anything, and leave no error in the console. Needs Playwright and Debian's chromium.
"""

import sys
from pathlib import Path
from shutil import which

from playwright.sync_api import sync_playwright

WIDTHS = (1280, 400)
SOURCES = {"_modules", "_static", "explore"}  # the last has tests of its own
HERE = ("file:", "data:", "blob:")
FAULTS = """async () => {
  await window.MathJax?.startup?.promise;
  const all = query => [...document.querySelectorAll(query)];
  const wider = part => part.scrollWidth - part.clientWidth;
  const left = part => part.getBoundingClientRect().left;
  return {
    'pixels wider than its window': wider(document.documentElement) - 1,
    'formulas are wrong': all('[data-mjx-error]').length,
    'formulas are not set': all('.math').length - all('.math mjx-container').length,
    'formulas begin left of where they can be seen':
      all('div.math mjx-container').filter(one => left(one) < left(one.parentNode) - 1).length,
    'pixels of text wider than its place':
      Math.max(...all('.bd-article, .bd-content').map(wider)) - 1,
  };
}"""


def main(folder: Path) -> int:
    """Return 1 if a page has a fault; say which."""
    files = [page for page in sorted(folder.rglob("*.html")) if not SOURCES & set(page.parts)]
    bad, said = 0, []
    with sync_playwright() as tool:
        browser = tool.chromium.launch(executable_path=which("chromium"), args=["--no-sandbox"])
        for width in WIDTHS:
            page = browser.new_page(viewport={"width": width, "height": 900})
            page.on("request", lambda it: it.url.startswith(HERE) or said.append(f"asks {it.url}"))
            page.on("requestfailed", lambda request: said.append(f"does not get {request.url}"))
            page.on("pageerror", lambda error: said.append(str(error)))
            page.on("console", lambda line: line.type != "error" or said.append(line.text))
            for file in files:
                said.clear()
                page.goto(file.as_uri())
                counts = page.evaluate(FAULTS).items()
                for fault in [*(f"{n} {what}" for what, n in counts if (n or 0) > 0), *said]:
                    bad += 1
                    print(f"{file.relative_to(folder)}, {width} pixels wide: {fault}")
    print(f"{len(files)} pages, {bad} faults")
    return int(bad > 0 or not files)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve()))
