"""``python -m batik_vector`` is the command."""

from batik_vector.cli import main

main()
