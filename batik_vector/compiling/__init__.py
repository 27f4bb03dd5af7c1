"""From a recipe to an artwork: the story is told in :mod:`~batik_vector.compiling.compiler`."""
