"""How Sphinx makes the site; tools/site.py puts together what it makes it of."""

from batik_vector import __version__

project = "batik_vector"
copyright = "the batik_vector authors"
release = version = __version__
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["html_image"]
myst_heading_anchors = 4
myst_links_external_new_tab = False
suppress_warnings = ["misc.highlighting_failure", "myst.header"]
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
html_theme = "furo"
html_title = "batik_vector"
html_short_title = "batik_vector"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "light_css_variables": {
        "color-brand-primary": "#1d2f5f",
        "color-brand-content": "#27407a",
        "color-background-secondary": "#f6f2e8",
        "color-sidebar-background": "#f6f2e8",
    },
    # What light sets, dark has to set again: the theme lays one over the other.
    "dark_css_variables": {
        "color-brand-primary": "#b9c9e4",
        "color-brand-content": "#9fb6dc",
        "color-background-secondary": "#191d2a",
        "color-sidebar-background": "#191d2a",
    },
}
