"""The place at which half of the shots pass, and how sharply: a probit fit to shots that pass or do not.

The share that passes at x is Phi((x - V50) / s), with the standard normal distribution Phi: V50 and s of the largest likelihood
(Bliss 1934; Finney 1971). All numbers have the unit of x."""

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

STEPS = 100
CONFIDENCE = 0.9
QUANTILE = NormalDist().inv_cdf(0.5 + CONFIDENCE / 2)


@dataclass(frozen=True)
class Probit:
    """middle, spread: V50 and s. errors: their standard errors. None: the shots do not say (`remark` says why)."""

    count: int
    passed: int
    middle: float | None = None
    spread: float | None = None
    errors: tuple = (None, None)
    remark: str = ""

    @property
    def slope(self):
        """Returns the slope at V50, of the share over x."""
        return None if self.spread is None else 1 / (self.spread * math.sqrt(2 * math.pi))

    def share(self, x):
        return None if self.spread is None else [phi((value - self.middle) / self.spread) for value in x]


def phi(z):
    return 0.5 * math.erfc(-z / math.sqrt(2))


def fit(places, passes, rises=True):
    """Returns the fit. passes: whether the shot at each place passed. rises: whether more pass at a larger x."""
    x = np.asarray(places, dtype=float) * (1 if rises else -1)
    y = np.asarray(passes, dtype=bool)
    count, passed = len(y), int(y.sum())
    if passed in (0, count):
        return Probit(count, passed, remark="all shots pass" if passed else "no shot passes")
    last, first = x[~y].max(), x[y].min()
    if last <= first:
        return Probit(count, passed, middle=float((last + first) / 2) * (1 if rises else -1),
                      remark="no mixed results: all shots beyond one place pass and none before it, so that no slope can be given")
    centre, scale = x.mean(), x.std()
    found = largest_likelihood((x - centre) / scale, y)
    if found is None:
        return Probit(count, passed, remark="the share that passes does not rise with x")
    (intercept, slope), covariance = found
    middle, spread = -intercept / slope, 1 / slope
    # By the first order of V50 = -b0 / b1 and s = 1 / b1.
    by = np.array([[-1 / slope, intercept / slope**2], [0.0, -1 / slope**2]])
    errors = scale * np.sqrt(np.diag(by @ covariance @ by.T))
    return Probit(count, passed, float(centre + scale * middle) * (1 if rises else -1), float(scale * spread),
                  (float(errors[0]), float(errors[1])))


def largest_likelihood(x, y):
    """Returns ((b0, b1), covariance) of the share Phi(b0 + b1 x) by the method of scoring; None if b1 is not above 0."""
    b = np.array([NormalDist().inv_cdf(y.mean()), 0.0])
    matrix = np.column_stack([np.ones(len(x)), x])
    information = np.eye(2)
    for _ in range(STEPS):
        eta = np.clip(matrix @ b, -8, 8)
        share = np.clip([phi(z) for z in eta], 1e-15, 1 - 1e-15)
        density = np.exp(-eta**2 / 2) / math.sqrt(2 * math.pi)
        score = matrix.T @ (density * (y - share) / (share * (1 - share)))
        information = matrix.T @ (matrix * (density**2 / (share * (1 - share)))[:, None])
        step = np.linalg.solve(information, score)
        step *= min(1.0, 2.0 / max(np.abs(step).max(), 1e-300))
        b = b + step
        if np.abs(step).max() < 1e-10:
            break
    return None if b[1] <= 0 else (b, np.linalg.inv(information))
