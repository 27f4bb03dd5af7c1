"""Reading recipes: files to text, text to values, and what is wrong with them in words."""
