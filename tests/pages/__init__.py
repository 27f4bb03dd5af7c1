"""What the pages say can be typed: every call, every recipe and every line of Python of README and docs/."""
