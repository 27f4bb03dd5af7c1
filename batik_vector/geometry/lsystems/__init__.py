"""L-systems: words rewritten in parallel, and the turtle that walks along them."""
