"""Plants and animals as motifs, a file for each family: made of curves by parameters, each part named."""
