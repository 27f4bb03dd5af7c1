"""The studio: a recipe is worked at with its picture beside it, and every step can be taken back."""
