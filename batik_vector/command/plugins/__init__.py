"""Where batik_vector is a guest in other programs: vpype. Each module is loaded by its host alone."""
