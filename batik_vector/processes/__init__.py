"""Processes: what machines need done to pages before they are written, as passes from page to page."""
