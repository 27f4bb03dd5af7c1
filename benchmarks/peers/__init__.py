"""One script for each way of drawing; each is run as a process of its own."""
