"""Fits of residual velocities against impact velocities. All values are SI.

All are Lambert and Jonas (1976), V_r = a (V^p - V_bl^p)^(1/p) above the ballistic limit V_bl and 0 below it. Recht and Ipson
(1963) have p = 2, and a = M / (M + m) with the mass m of a plug; p = 1 is a straight line that falls to zero.
"""

from dataclasses import dataclass

import numpy as np

LAMBERT_JONAS, RECHT_IPSON, LINEAR = "Lambert-Jonas", "Recht-Ipson", "linear"
# Name: the power, None where it is fitted.
POWERS = {RECHT_IPSON: 2.0, LAMBERT_JONAS: None, LINEAR: 1.0}
LEAST_POWER, LARGEST_POWER = 1.0, 10.0  # a fitted power beyond them says nothing: the curve is a line or a step
NEAR = 1e-9      # part of the lowest velocity with an exit that the limit stays below it
STEPS = 200      # of the search for the smallest sum of squares, at most
GRID = (60, 37)  # places of the limit and of the power where it begins


@dataclass(frozen=True)
class Fit:
    """A fitted curve. errors: standard errors of limit, factor and, if it was fitted, power; None where the points leave none."""

    name: str
    limit: float    # V_bl, m/s
    factor: float   # a
    power: float    # p
    errors: tuple
    deviation: float | None  # root of the sum of squares over the degrees of freedom, m/s
    count: int      # of points with an exit
    remark: str = ""

    def at(self, velocity):
        """Returns the residual velocity, m/s, of one or many impact velocities."""
        return residual(np.asarray(velocity, dtype=float), (self.limit, self.factor, self.power))


def residual(velocity, parameters):
    limit, factor, power = parameters
    # In powers of the ratio, so that no number overflows.
    ratio = np.minimum(1.0, limit / velocity)
    return factor * velocity * (1 - ratio**power) ** (1 / power)


def fit(name, velocity, found):
    """Returns the least-squares fit of residual velocities, each counted alike, or None if there are too few: as many points with an
    exit as there are parameters and one more. Points that were stopped (0 m/s) count where a curve passes above them."""
    velocity, found = np.asarray(velocity, dtype=float), np.asarray(found, dtype=float)
    fixed, passed = POWERS[name], found > 0
    free = 2 if fixed else 3
    if passed.sum() < free + 1:
        return None
    edge = velocity[passed].min() * (1 - NEAR)
    best = refined(start(velocity, found, edge, fixed), velocity, found, edge, free)
    squares = float(np.sum((found - residual(velocity, best)) ** 2))
    deviation = float(np.sqrt(squares / (passed.sum() - free)))
    return Fit(name, *(float(x) for x in best), errors_of(best, velocity, deviation, free), deviation, int(passed.sum()),
               remark_of(name, best, velocity, found))


def remark_of(name, best, velocity, found):
    limit, factor, power = best
    words = []
    if POWERS[name] is None and not LEAST_POWER * 1.001 < power < LARGEST_POWER * 0.999:
        words.append("the power is at the end of what is searched")
    if factor > 1 and name != LINEAR:
        words.append("the factor is above 1, which no plug explains")
    stopped = velocity[found <= 0]
    if len(stopped) and stopped.max() > limit:
        words.append(f"stopped at {stopped.max():g} m/s, above the limit of the fit")
    return "; ".join(words)


def start(velocity, found, edge, fixed):
    """Returns the best of a grid of limits and powers; the factor follows from them, as the curve is proportional to it."""
    best, least = None, np.inf
    for power in [fixed] if fixed else np.geomspace(LEAST_POWER, LARGEST_POWER, GRID[1]):
        for limit in np.linspace(0, edge, GRID[0], endpoint=False):
            shape = residual(velocity, (limit, 1.0, power))
            factor = shape @ found / (shape @ shape)
            squares = np.sum((found - factor * shape) ** 2)
            if squares < least:
                best, least = np.array([limit, factor, power]), squares
    return best


def slopes(parameters, velocity, free):
    """Returns the derivatives of the curve by the first `free` parameters, one column each, by central differences."""
    columns = []
    for k in range(free):
        step = np.zeros(3)
        step[k] = 1e-6 * max(abs(parameters[k]), 1e-3)
        columns.append((residual(velocity, parameters + step) - residual(velocity, parameters - step)) / (2 * step[k]))
    return np.array(columns).T


def refined(parameters, velocity, found, edge, free):
    """Returns the parameters of the smallest sum of squares near some others, by the damped steps of Levenberg and Marquardt."""
    low, high = np.array([0.0, 0.0, LEAST_POWER]), np.array([edge, np.inf, LARGEST_POWER])
    damping, squares = 1e-3, np.sum((found - residual(velocity, parameters)) ** 2)
    for _ in range(STEPS):
        matrix = slopes(parameters, velocity, free)
        normal = matrix.T @ matrix
        right = matrix.T @ (found - residual(velocity, parameters))
        step = np.zeros(3)
        try:
            step[:free] = np.linalg.solve(normal + damping * np.diag(np.diag(normal) + 1e-300), right)
        except np.linalg.LinAlgError:
            break
        other = np.clip(parameters + step, low, high)
        there = np.sum((found - residual(velocity, other)) ** 2)
        if there < squares:
            small = np.all(np.abs(other - parameters) <= 1e-10 * np.maximum(np.abs(parameters), 1e-3))
            parameters, squares, damping = other, there, damping / 5
            if small:
                break
        elif damping > 1e12:
            break
        else:
            damping *= 5
    return parameters


def errors_of(parameters, velocity, deviation, free):
    """Returns the standard errors of the parameters, from the inverse of the normal matrix and the scatter about the curve. A power at
    the end of its range has none."""
    matrix = slopes(parameters, velocity, free)
    at_end = free == 3 and not LEAST_POWER * 1.001 < parameters[2] < LARGEST_POWER * 0.999
    kept = matrix[:, :2] if at_end else matrix
    try:
        found = deviation * np.sqrt(np.diag(np.linalg.inv(kept.T @ kept)))
    except np.linalg.LinAlgError:
        return (None,) * free
    found = tuple(float(error) if np.isfinite(error) else None for error in found)
    return found + (None,) if at_end else found


def in_words(fitted):
    """Returns a fit in words: limit, factor and power with their standard errors."""
    def word(value, error, digits, unit=""):
        return f"{value:.{digits}f}{'' if error is None else f' +- {error:.{digits}f}'}{unit}"

    error = (*fitted.errors, None)[:3]
    words = f"V_bl {word(fitted.limit, error[0], 1, ' m/s')}, a {word(fitted.factor, error[1], 3)}"
    if POWERS[fitted.name] is None:
        words += f", p {word(fitted.power, error[2], 2)}"
    return f"{fitted.name}: {words}, scatter {fitted.deviation:.1f} m/s" + (f" ({fitted.remark})" if fitted.remark else "")
