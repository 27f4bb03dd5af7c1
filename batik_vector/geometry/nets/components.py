"""What hangs together."""

from __future__ import annotations

import numpy as np

from batik_vector.geometry.outlines import Index
from batik_vector.geometry.sampling import Indices


def components(count: int, pairs: Indices) -> Index:
    """Return for each of ``count`` items the least item that a chain of pairs connects it with.

    Labels are hooked onto smaller ones and pointers doubled, so the rounds grow with the logarithm of the
    longest chain (Shiloach and Vishkin, 1982).
    """
    label = np.arange(count)
    while True:
        low = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
        before = label.copy()
        for side in (0, 1):
            np.minimum.at(label, before[pairs[:, side]], low)
            np.minimum.at(label, pairs[:, side], low)
        while True:
            jumped = label[label]
            if np.array_equal(jumped, label):
                break
            label = jumped
        if np.array_equal(label, before):
            return label
