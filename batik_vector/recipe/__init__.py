"""The recipe: what a page of TOML may say, and how it is read."""
