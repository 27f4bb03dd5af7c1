"""``python -m batik_vector`` is the command."""

from batik_vector.command.cli import main

main()
