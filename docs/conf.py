"""Settings of the documentation site, which `sh docs/build` makes in build/site."""

import os
from importlib.metadata import version as version_of
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive
from gapbeam.cli.command import _parser

DOCS = Path(__file__).parent

project = "gapbeam"
author = "The gapbeam authors"
copyright = author
version = release = version_of("gapbeam")

extensions = ["myst_parser", "sphinx_design", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
exclude_patterns = ["_static"]
suppress_warnings = ["misc.highlighting_failure", "ref.python"]   # JSON with ... in it; attributes of the same name
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 4
myst_links_external_new_tab = False

add_module_names = False
autodoc_member_order = "bysource"
autodoc_typehints = "none"   # the docstrings tell types, with units
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True

html_theme = "pydata_sphinx_theme"
html_title = f"gapbeam {version}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
html_domain_indices = False
html_sidebars = {"languages": []}   # it has no pages below it
html_show_sphinx = False
html_theme_options = {
    "logo": {"text": "gapbeam"},
    "navbar_align": "left",
    "header_links_before_dropdown": 8,
    "show_prev_next": True,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": ["theme-version"],
    "pygments_light_style": "tango",
    "pygments_dark_style": "github-dark",
}


class Help(Directive):
    """The help of a command, as it prints it: ``{help} run``."""

    optional_arguments = 1
    final_argument_whitespace = True

    def run(self):
        """Give a block of text."""
        os.environ["COLUMNS"] = "100"
        parser = _parser()
        for name in (self.arguments or [""])[0].split():
            parser = next(action for action in parser._actions if action.choices).choices[name]
        text = parser.format_help()
        return [nodes.literal_block(text, text, language="text")]


def setup(app):
    """Add what is special here."""
    app.add_directive("help", Help)
