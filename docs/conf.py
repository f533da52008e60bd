"""The manual: `sphinx-build -W --keep-going docs manual`."""

import sys
from importlib.util import find_spec
from pathlib import Path

sys.path.insert(0, str(Path(__file__).with_name("_ext")))


from carom.io.version import __version__

project = "Carom"
author = "The Carom developers"
version = release = __version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinx_external_toc",
    "sphinx_gallery.gen_gallery",
    "contents",
    "explore_links",
    "formulas",
    "glossary_links",
    "names",
    "schema",
]
templates_path = ["_templates"]
suppress_warnings = [
    "etoc.toctree",  # reference and Cookbook have their own tables of contents
    "sphinx_gallery.config",  # the Cookbook names scripts, not the functions that they use
]
exclude_patterns = ["_ext", "gallery/*.ipynb", "gallery/*.py"]
default_role = "code"
smartquotes = False  # "--json" is not a dash
toc_object_entries_show_parents = "hide"

myst_enable_extensions = ["amsmath", "colon_fence", "dollarmath"]
myst_heading_anchors = 3

# MathJax as one file that comes with the pages: they ask no other host for anything.
_mathjax = Path(find_spec("sphinx-mathjax-offline").origin).parent / "static/mathjax"
mathjax_path = "tex-svg-full.js"
mathjax3_config = {
    "svg": {"mtextInheritFont": True},
    "tex": {"packages": {"[-]": ["noundefined"]}},  # what is misspelt is an error
}

autodoc_typehints = "none"
autodoc_preserve_defaults = True
autodoc_member_order = "bysource"
autosummary_generate = [str(page) for page in Path(__file__).parent.glob("reference/*.rst")]
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False

sphinx_gallery_conf = {
    "examples_dirs": "../examples",
    "gallery_dirs": "gallery",
    "filename_pattern": r"\.py$",
    "image_scrapers": ("pictures.take_picture",),
    "thumbnail_size": (1110, 740),
    "reset_modules": ("pictures.clear",),
    "reset_modules_order": "after",
    "show_memory": False,
    "download_all_examples": False,
    "show_signature": False,
    "within_subsection_order": "pictures.place_in_index",
    "minigallery_sort_order": "pictures.place_in_index",
    "capture_repr": (),
    "last_notebook_cell": """\
# The picture that was stored last
from pathlib import Path

from IPython.display import Image

pictures = [path for path in Path().iterdir() if path.suffix in (".png", ".gif")]
Image(max(pictures, key=lambda path: path.stat().st_mtime))""",
    "nested_sections": False,
    "write_computation_times": False,
    "abort_on_example_error": True,
}

html_theme = "pydata_sphinx_theme"
html_title = "Carom"
html_static_path = ["_static", str(_mathjax / mathjax_path)]
html_css_files = ["manual.css"]
html_context = {"default_mode": "auto"}
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "logo": {"text": "Carom"},
    "header_links_before_dropdown": 8,
    "navbar_align": "left",
    "show_toc_level": 2,
    "footer_start": ["copyright"],
    "footer_end": [],
}
html_sidebars = {page: [] for page in ("index",)}
