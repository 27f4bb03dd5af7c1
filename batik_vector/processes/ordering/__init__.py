"""Good orders: which stroke after which, from which end, so that the tool travels little with the pen up."""
