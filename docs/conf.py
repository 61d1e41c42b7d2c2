"""How Sphinx builds the documentation: `./hydro docs`. The pages are Markdown that reads as well on its own.

The source folder is the checkout, because pages link to tables and pictures of `results/`.
"""

import importlib.metadata
import re
from typing import Any

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.util import logging

project = "hydroelastic"
version = release = importlib.metadata.version("hydroelastic")
copyright = "the hydroelastic authors, MIT licence"

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
root_doc = "docs/index"
include_patterns = [
    "docs/**",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "README.md",
    "results/README.md",
    "results/shipped/README.md",
    # Named, because what a run writes lies beside them.
    *(f"results/{name}/*.md" for name in ("benchmarks", "float_cases", "hard_cases", "level_cases", "thread_cases")),
]

html_theme = "furo"
html_title = f"hydroelastic {version}"
# The site is read from the disk as well: nothing of it comes from the net.
html_static_path = ["site.css"]
# index.html at the root of the site leads to that of the pages.
html_extra_path = ["site_root"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False

# Anchors of headings are those that a reader of the Markdown files sees.
myst_heading_anchors = 4
# Formulas as code-hosting sites show them: $…$ in a line, a fence labelled ``math`` on lines of its own.
myst_enable_extensions = ["dollarmath"]
myst_fence_as_directive = ["math"]
html_math_renderer = "mathml"

autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_member_order = "bysource"
# Said by their names, not by what they stand for.
autodoc_type_aliases = {name: name for name in ("ArrayLike", "npt.ArrayLike", "FloatArray", "Force", "Report")}
# Names of code in single backticks.
default_role = "code"
napoleon_use_ivar = True
napoleon_use_rtype = False
napoleon_attr_annotations = False
smartquotes = False


def _plain_text(_app: Any, _what: str, _name: str, _of: Any, _options: Any, lines: list[str]) -> None:
    """Take docstrings as the plain text that they are: indented blocks are formulas, bars absolute values."""
    shown: list[str] = []
    margin, block = 0, None
    for line in lines:
        indent = len(line) - len(line.lstrip())
        if line and block is not None and indent < block:
            block = None
        if line and block is None:
            if shown and not shown[-1] and indent > margin:
                shown += [f"{' ' * margin}::", ""]
                block = indent
            margin = indent if block is None else margin
        shown.append(line if block is not None else _with_bars(line))
    lines[:] = shown


def _with_bars(line: str) -> str:
    """Bars are no substitutions; those in ``literals`` are left."""
    parts = line.split("``")
    parts[::2] = [part.replace("|", r"\|") for part in parts[::2]]
    return "``".join(parts)


def _mathml(translator: Any, node: nodes.math | nodes.math_block) -> None:
    """Write a formula as MathML, which browsers show without scripts and fonts; what is not understood is a warning."""
    is_block = isinstance(node, nodes.math_block)
    try:
        shown = str(tex2mathml(node.astext(), as_block=is_block))
        # Few devices have a font with the italics of mathematics, above all Greek ones: ordinary letters are slanted.
        shown = re.sub(r"<mi>(\w)</mi>", r'<mi class="variable" mathvariant="normal">\1</mi>', shown)
        shown = re.sub(r"<mi(?: class=.capital-greek.)?>(.)</mi>", r'<mi mathvariant="normal">\1</mi>', shown)
        shown = re.sub(r"<mi>(\w+)</mi>", r'<mo lspace="0.17em" rspace="0.17em">\1</mo>', shown)
    except MathError as error:
        logging.getLogger(__name__).warning("%s: %s", error, node.astext(), location=node)
        shown = translator.encode(node.astext())
    translator.body.append(f'<div class="math">{shown}</div>' if is_block else shown)
    raise nodes.SkipNode


def setup(app: Sphinx) -> None:
    """Called by Sphinx."""
    app.add_html_math_renderer("mathml", (_mathml, None), (_mathml, None))
    before_napoleon = 400
    app.connect("autodoc-process-docstring", _plain_text, priority=before_napoleon)
