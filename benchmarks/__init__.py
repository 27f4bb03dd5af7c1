"""What batik_vector costs, beside its peers: see README.md in this folder."""
