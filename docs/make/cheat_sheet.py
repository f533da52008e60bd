"""Print the cheat sheet of the built manual on one page: docs/_static/cheatsheet.pdf.

python docs/make/cheat_sheet.py manual    needs Playwright and a chromium
"""

import shutil
import sys
from pathlib import Path

from playwright.sync_api import sync_playwright

PRINTED = Path(__file__).parents[1] / "_static/cheatsheet.pdf"
STYLE = """
.pst-skip-link, .bd-header, .bd-footer, .header-article, .bd-header-article, .prev-next-footer,
.copybtn, .headerlink, .bd-sidebar, .bd-sidebar-primary, .bd-sidebar-secondary, footer,
article section > p:first-of-type:has(a) { display: none !important }
html { font-size: 12px !important }
.bd-page-width, .bd-main .bd-content .bd-article-container { max-width: none !important }
.bd-article, .bd-article-container { padding: 0 !important }
article h1 { font-size: 2rem; margin: 0 0 .5rem }
article h2 { font-size: 1.4rem; margin: .8rem 0 .3rem }
article p, article table { margin: .3rem 0 }
td, th { padding: .2rem .5rem !important }
article pre { font-size: .9rem !important; padding: .5rem !important; margin: .3rem 0 }
"""


def main(manual: str) -> None:
    """Print the page on A4."""
    with sync_playwright() as play:
        browser = play.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        page = browser.new_page()
        page.goto((Path(manual) / "cheatsheet.html").resolve().as_uri())
        page.wait_for_function("window.MathJax && MathJax.startup && MathJax.startup.promise")
        page.evaluate("MathJax.startup.promise")
        page.add_style_tag(content=STYLE)
        margin = dict.fromkeys(("top", "bottom", "left", "right"), "11mm")
        page.pdf(path=PRINTED, format="A4", margin=margin, print_background=True)
        browser.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
