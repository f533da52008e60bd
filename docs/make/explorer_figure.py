"""Draw the page of `carom explore` as a browser shows it: docs/figures/explorer/.

Needs a browser and Playwright: python docs/make/explorer_figure.py
"""

from io import BytesIO
from pathlib import Path
from shutil import which
from threading import Thread

from PIL import Image
from playwright.sync_api import sync_playwright

from carom.page import explorer

FIGURES = Path(__file__).parents[1] / "figures" / "explorer"
VIEW = "?angle=25&friction=0.25&time=0.6&theme=light&level=full"
STATE = f"{VIEW}&law=mindlin&law=YADE+Mindlin&law=Walton+%26+Braun&data=kharaz2001"
SIZE = {"width": 1440, "height": 900}
PICTURES = {  # states
    "first": "?theme=light",
    "story": "?theme=light&story=contact.1",
    "1440": STATE,
    "fit": STATE + "&tab=Measurements",
}


def main() -> None:
    """Serve the page, open its states, and store what is seen."""
    page = explorer(port=0)
    Thread(target=page.serve, daemon=True).start()
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=which("chromium"), args=["--no-sandbox"])
        for name, state in PICTURES.items():
            tab = browser.new_page(viewport=SIZE, reduced_motion="reduce")
            tab.goto(page.url + state)
            tab.wait_for_timeout(8000)  # laws, fits and charts are all there
            if name == "story":
                tab.get_by_role("button", name="Show me").click()
                tab.wait_for_timeout(2000)
            picture = Image.open(BytesIO(tab.screenshot())).convert("RGB")
            picture.save(FIGURES / f"{name}.png", optimize=True)
            tab.close()
    page.stop()


if __name__ == "__main__":
    main()
