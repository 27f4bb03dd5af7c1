"""Files made of recipes: of one, of many on all cores, and of a recipe's variants."""
