"""Draw docs/figures/explorer.png: the page of `carom explore` as a browser shows it.

Needs a browser and Playwright: python docs/make/explorer_figure.py
"""

import shutil
from io import BytesIO
from pathlib import Path
from threading import Thread

from PIL import Image
from playwright.sync_api import sync_playwright

from carom.explorer import explorer

FIGURE = Path(__file__).parents[1] / "figures" / "explorer.png"
STATE = "?angle=25&friction=0.25&law=mindlin&time=0.6&theme=light"
SIZE = {"width": 1280, "height": 920}


def main() -> None:
    """Serve the page, open a state of it, and store what is seen."""
    page = explorer(port=0)
    Thread(target=page.serve, daemon=True).start()
    with sync_playwright() as play:
        browser = play.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        tab = browser.new_page(viewport=SIZE)
        tab.goto(page.url + STATE)
        tab.wait_for_selector("#forces .main-svg")
        tab.wait_for_timeout(2000)
        seen = BytesIO(tab.screenshot())
        browser.close()
    page.stop()
    Image.open(seen).convert("RGB").save(FIGURE, optimize=True)


if __name__ == "__main__":
    main()
