# SPDX-License-Identifier: MIT
"""Sphinx reads this: docs/build.sh."""

import os

project = "Tactus"
author = "the authors of Tactus"
copyright = author   # pylint: disable=redefined-builtin
version = release = os.environ["TACTUS_VERSION"]

extensions = ["myst_parser", "breathe", "nbsphinx", "sphinx.ext.mathjax"]
myst_enable_extensions = ["colon_fence", "dollarmath"]
myst_heading_anchors = 6
breathe_projects = {"tactus": os.environ["TACTUS_XML"]}
breathe_default_project = "tactus"
breathe_domain_by_extension = {"h": "c"}
primary_domain = None
highlight_language = "none"
pygments_style, pygments_dark_style = "default", "github-dark"   # all of their colours can be read

nbsphinx_execute = "always"
nbsphinx_requirejs_path = ""   # nothing is loaded from elsewhere
nbsphinx_allow_errors = False

# Debian's MathJax, of which docs/build.sh copies what the pages need.
mathjax_path = "mathjax/MathJax.js?config=TeX-MML-AM_CHTML"
mathjax2_config = {"messageStyle": "none"}

suppress_warnings = ["misc.highlighting_failure"]   # code with an ellipsis

html_theme = "furo"
html_title = f"Tactus {version}"
html_static_path = ["_static"]
html_favicon = "_static/icon.svg"
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
exclude_patterns = ["files"]

# Types of the C library and of the compiler have no page here.
nitpick_ignore_regex = [("c:identifier", r"(u?int(8|16|32|64)|size|ptrdiff)_t|bool|FILE")]

