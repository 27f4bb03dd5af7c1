"""What wax and hand leave on cloth: cracks, and lines that live."""
