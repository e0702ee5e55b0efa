# SPDX-License-Identifier: MIT
"""Random draws that are the same on every computer: an order that a seed has given once can be given again."""

from __future__ import annotations

import hashlib
import random
import statistics
from typing import List, Sequence, TypeVar

T = TypeVar("T")


class Draw:
    """Random numbers from a key, such as a seed, a participant and a block. Only random.random() is used, which Python promises to keep the same for a
    seed; the order of random.shuffle is not promised."""

    def __init__(self, *key: object):
        """key: parts whose texts, together, are the seed."""
        self._random = random.Random(int.from_bytes(hashlib.sha256(repr([str(part) for part in key]).encode()).digest(), "big"))

    def uniform(self) -> float:
        """A number from 0 (included) to 1 (not included)."""
        return self._random.random()

    def below(self, count: int) -> int:
        """A whole number from 0 to count - 1."""
        return int(self._random.random() * count)

    def normal(self) -> float:
        """A number of the standard normal distribution."""
        return statistics.NormalDist().inv_cdf(max(self._random.random(), 2.0 ** -54))

    def order(self, items: Sequence[T]) -> List[T]:
        """The items in a random order (Fisher and Yates)."""
        mixed = list(items)
        for i in range(len(mixed) - 1, 0, -1):
            k = self.below(i + 1)
            mixed[i], mixed[k] = mixed[k], mixed[i]
        return mixed


def latin_square(count: int, row: int) -> List[int]:
    """A row of a balanced square (Williams 1949): over `count` rows, each item comes once at each place, and with an even count each item follows each other
    one once; an odd count needs the mirrored rows too, so there are 2 * count of them."""
    row %= count if count % 2 == 0 else 2 * count
    found = [((i + 1 if i % 2 else -i) // 2 + row) % count for i in range(count)]
    return found[::-1] if row >= count else found
