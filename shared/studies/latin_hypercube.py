"""Latin hypercube samples that can be extended.

With n = FIRST, 2 FIRST, 4 FIRST, ... samples each of the n intervals of equal probability of every input holds exactly one
sample, and the inputs are paired at random. A doubling keeps the samples that there are: each of them lies in one half of its
interval, and the new ones get the other halves. With a number between, the last doubling is incomplete.

The draws of an input depend on the seed and on its name only, and are made of raw bits of PCG64, which numpy promises not to
change: they are the same on any machine, whatever the number of samples, and whatever other inputs there are."""

import numpy as np

FIRST = 25


def places(seed, name, count):
    """Returns the places of an input in (0, 1): an array of `count` numbers. seed: an integer >= 0."""
    bits = np.random.PCG64(np.random.SeedSequence([seed, *name.encode("utf-8")]))
    strata = permutation(bits, FIRST)
    within = uniform(bits, FIRST)
    found = (strata + within) / FIRST
    while len(found) < count:
        n = len(found)
        upper = within >= 0.5
        strata, within = 2 * strata + upper, 2 * within - upper  # exact: those of the halves
        free = np.setdiff1d(np.arange(2 * n), strata)[permutation(bits, n)]
        new = uniform(bits, n)
        found = np.concatenate([found, (free + new) / (2 * n)])
        strata, within = np.concatenate([strata, free]), np.concatenate([within, new])
    return found[:count]


def uniform(bits, count):
    """Returns numbers in (0, 1), multiples of 2^-52 plus its half."""
    return (np.asarray(bits.random_raw(count), dtype=np.uint64) >> np.uint64(12)).astype(float) * 2.0**-52 + 2.0**-53


def permutation(bits, count):
    return np.argsort(np.asarray(bits.random_raw(count), dtype=np.uint64), kind="stable")


def is_complete(count):
    """Returns whether every interval holds one sample."""
    return count % FIRST == 0 and (count // FIRST) & (count // FIRST - 1) == 0
