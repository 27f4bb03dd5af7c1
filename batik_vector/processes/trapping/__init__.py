"""Kernels of trapping: where inks meet side by side, and how far the one spreads under the other there."""
