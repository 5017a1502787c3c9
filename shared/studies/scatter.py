"""Statistics of an answer that scatters with the inputs: its band, how sure that is, and which input contributes how much."""

import math

import numpy as np

LEVELS = (0.05, 0.5, 0.95)
CONFIDENCE = 0.9  # that a quantile lies in its interval; at each side 0.05 are left, so that 59 samples bound both ends
PER_INPUT = 10    # samples for each regressor, below which shares of variance mean little
FEWEST = 10       # samples from which on a band is given
RESAMPLES = 100   # for the errors of the shares
SOUND = 0.7       # share of variance that a sum of the inputs' effects should have


def quantiles(values):
    """Returns the quantiles at LEVELS of n numbers: interpolated between the two order statistics around them, median-unbiased."""
    return [float(q) for q in np.quantile(values, LEVELS, method="median_unbiased")]


def ranks_around(count, level):
    """Returns (r, s): the quantile lies between the r-th and the s-th smallest of `count` values with CONFIDENCE, whatever the
    distribution; 0 and count + 1 stand for ends that so few values do not bound. From the binomial distribution of the number of
    values below the quantile, as for independent samples; those of a Latin hypercube scatter less."""
    k = np.arange(count + 1)
    log_factorial = np.concatenate([[0.0], np.cumsum(np.log(np.arange(1, count + 1)))])
    log_mass = (log_factorial[count] - log_factorial[k] - log_factorial[count - k] + k * math.log(level) +
                (count - k) * math.log(1 - level))
    below = np.cumsum(np.exp(log_mass))  # probability of at most k values below the quantile
    tail = 0.5 * (1 - CONFIDENCE)
    lower = int(np.count_nonzero(below <= tail))
    upper = int(np.count_nonzero(1 - below > tail)) + 1
    return lower, upper


def band(values):
    """Returns [{level, value, low, high}]; low, high: order statistics around the quantile, None where there is no bound."""
    ordered, found = np.sort(values), []
    for level, value in zip(LEVELS, quantiles(values)):
        r, s = ranks_around(len(ordered), level)
        found.append({"level": level, "value": value, "low": float(ordered[r - 1]) if r >= 1 else None,
                      "high": float(ordered[s - 1]) if s <= len(ordered) else None})
    return found


def growth(values, used):
    """Returns [{samples, band}] of the first samples, from FEWEST to all: how the band changes with their number. used: for each
    value the number of its sample, from 0, ascending."""
    total = int(used[-1]) + 1
    counts = sorted({int(round(n)) for n in np.geomspace(FEWEST, total, 24)} | {total}) if total > FEWEST else [total]
    first = [(count, values[used < count]) for count in counts]
    return [{"samples": count, "band": band(some)} for count, some in first if len(some) >= min(FEWEST, len(values))]


def ranks(values):
    """Returns the ranks of numbers; equal ones share the mean of theirs."""
    ordered, place, count = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(count)
    return (last - 0.5 * (count - 1))[place] if len(ordered) else np.array([])


def standardised(values):
    """Returns numbers of mean 0 and standard deviation 1; zeros if all are equal."""
    centred = np.asarray(values, dtype=float) - np.mean(values)
    deviation = np.sqrt(np.mean(centred**2))
    return centred / deviation if deviation > 1e-12 * max(1.0, np.abs(values).max()) else np.zeros(len(centred))


def regressors(numbers, is_choice):
    """Returns the columns of an input, each standardised: its rank, or an indicator of each alternative but the first one that
    occurs."""
    if not is_choice:
        return [standardised(ranks(numbers))]
    return [standardised(numbers == alternative) for alternative in np.unique(numbers)[1:]]


def contributions(inputs, values):
    """Returns {shares, spearman, r2, r2_adjusted, regressors}. inputs: {name: (numbers, is_choice)} with as many numbers as values.

    The ranks of the answer are regressed on the ranks of the inputs, all standardised. The share of an input is the sum over its
    columns of coefficient times correlation with the answer: for independent inputs the square of the coefficient, in every case
    numbers that add up to R^2. spearman: rank correlation, None for a choice. Shares are None if there are too few samples."""
    answer = standardised(ranks(values))
    columns = {name: regressors(*of) for name, of in inputs.items()}
    spearman = {name: None if inputs[name][1] else float(np.mean(found[0] * answer)) for name, found in columns.items()}
    matrix = np.array([column for found in columns.values() for column in found]).reshape(-1, len(answer)).T
    n, p = len(answer), matrix.shape[1]
    found = {"spearman": spearman, "regressors": p, "shares": dict.fromkeys(inputs), "r2": None, "r2_adjusted": None}
    if n <= p + 1 or not answer.any() or not p:
        return found
    coefficients = np.linalg.lstsq(matrix, answer, rcond=None)[0]
    parts = iter(coefficients * (matrix.T @ answer) / n)
    found["shares"] = {name: float(sum(next(parts) for _ in own)) for name, own in columns.items()}
    found["r2"] = sum(found["shares"].values())
    found["r2_adjusted"] = 1 - (1 - found["r2"]) * (n - 1) / (n - p - 1)
    return found


def share_errors(inputs, values):
    """Returns {name: standard deviation of its share} over RESAMPLES draws of as many samples with replacement (bootstrap); None
    where there are no shares. The draws are the same on any machine. inputs: as in contributions()."""
    bits, count, found = np.random.PCG64(1), len(values), []
    for _ in range(RESAMPLES):
        some = (np.asarray(bits.random_raw(count), dtype=np.uint64) % np.uint64(count)).astype(int)
        drawn = {name: (numbers[some], is_choice) for name, (numbers, is_choice) in inputs.items()}
        shares = contributions(drawn, values[some])["shares"]
        if None not in shares.values():
            found.append(list(shares.values()))
    return dict(zip(inputs, np.std(found, axis=0).tolist())) if len(found) > RESAMPLES // 2 else dict.fromkeys(inputs)


def noise(count):
    """Returns the rank correlation that an input without effect exceeds in one of twenty studies."""
    return 1.96 / math.sqrt(count - 1) if count > 1 else 1.0


def cautions(count, found):
    """Returns sentences on what the contributions do not carry. found: from contributions()."""
    p, words = found["regressors"], []
    if found["r2"] is None:
        return [f"no shares of variance: {count} values for {p} regressors (an input, or an alternative beyond the first), or an "
                "answer that does not change"]
    if count < PER_INPUT * p:
        words.append(f"{count} values are few for {p} regressors: shares and R2 are uncertain below {PER_INPUT * p}")
    if found["r2"] < SOUND:
        words.append(f"a sum of the inputs' effects gives only {100 * found['r2']:.0f} % of the variance of the ranks: the rest is "
                     "of inputs without order such as seeds, of effects that are not monotonic, and of inputs that act together")
    return words
