"""The documentation as a site: the Markdown pages of this folder, built offline by `./dev docs`."""
import re
from pathlib import Path

root = Path(__file__).resolve().parent.parent
project = "Bolter"
author = "Bolter developers"
copyright = "Bolter developers, GPL-3.0-or-later"
version = release = re.search(
    r"project\(bolter VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text()).group(1)

extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4
suppress_warnings = ["misc.highlighting_failure"]
exclude_patterns = ["_build"]

html_theme = "sphinx_rtd_theme"
html_theme_options = {"navigation_depth": 3}
html_show_sourcelink = False
html_static_path = []
