"""The text of a recipe: changed without a change to what is not meant, values spelled as those before."""
