"""What a person types, and what is printed: the command ``batik-vector``."""
