"""Strength and fracture energy of concrete in tension, read off computed tests as the experimenters do.

A bar along z is a stack of layers of points. The force in a plane follows from the balance of momentum of all that lies behind
it, so that no stress of a point is needed. Everything is SI; tension is positive."""

from dataclasses import dataclass

import numpy as np

# A crack has opened when its force has fallen to this part of the peak.
OPENED = 0.05
# The wave of a crack has reached the free end when its velocity, after a fall by this part of the largest, rises by that one.
FALL = 0.2
REBOUND = 0.05
# Gauge over which the opening of a crack is read, in diameters of the bar.
GAUGE = 0.7
# A plane is a crack of its own if it is wider open than the planes beside it and has taken this part of the work of the widest one.
# The four cracks of the shipped spall bar have taken 0.78 to 1 of it (0.88 to 1 with cells of 2.6 mm): any part below counts four.
SAME = 0.5


@dataclass
class Bar:
    """Layers of a bar from its lower end to its upper one, n of them at m times."""

    time: np.ndarray  # m
    place: np.ndarray  # n: of the layers at the start
    mass: np.ndarray  # n: of the whole bar
    displacement: np.ndarray  # m x n: mean along z
    velocity: np.ndarray  # m x n
    area: float
    density: float

    def force_below(self, layer):
        """Returns the force in the plane below a layer, by the momentum of this and all higher layers: their end is free."""
        return -np.gradient(self.velocity[:, layer:] @ self.mass[layer:], self.time)

    def wave_speed(self):
        """Returns the speed at which half of the height of the first wave goes from an eighth to the middle of the bar, None
        without a wave. The fronts of a bar that flows travel faster than the peaks."""
        first, last = len(self.place) // 8, len(self.place) // 2
        arrivals = [front(self.time, self.velocity[:, layer]) for layer in (first, last)]
        if None in arrivals or not arrivals[1] > arrivals[0]:
            return None
        return float((self.place[last] - self.place[first]) / (arrivals[1] - arrivals[0]))


@dataclass
class Spall:
    """What a spall bar says. None: not known, as the free end has not rebounded."""

    wave_speed: float | None  # by the fronts
    pulse_in: float  # largest compression at a tenth of the bar
    pulse_out: float  # the same a diameter before the free end
    top: float  # largest velocity of the free end
    strength: float | None  # by the pull-back of the free end
    rate: float | None  # strain rate of the pull-back
    distance: float  # of the widest crack from the free end
    carried: float  # largest mean tension in its plane
    opening: float  # at the end, over the gauge, of all cracks in it
    cracks: int  # in the gauge
    fracture_energy: float  # of one of them: the work in the gauge over their number
    left: float  # part of its peak force that the crack still carries at the end, 0: none

    @property
    def open(self):
        """Returns whether there is a crack: a tension up to the peak cannot do more work than the peak times the opening."""
        return 0 < self.cracks * self.fracture_energy <= self.opening * self.carried


@dataclass
class Pull:
    """What a bar says whose ends are pulled apart."""

    strength: float
    rate: float  # strain rate of the ends
    opening: float  # of the ends at the end
    fracture_energy: float
    left: float


@dataclass
class Split:
    """What a cube says that is split between two strips."""

    strength: float  # 2 F / (pi h b), EN 12390-6, by the largest force F
    closing: float  # of the strips at the largest force
    left: float  # part of the largest force at the end


def first_top(values):
    """Returns the index of the first maximum that a fall by a tenth follows, above a fifth of the largest value."""
    best = 0
    for i, value in enumerate(values):
        if value > values[best]:
            best = i
        elif values[best] > 0.2 * np.max(values) and value < 0.9 * values[best]:
            break
    return best if values[best] > 0 else None


def front(time, velocity):
    """Returns when the first wave has half of its height, None without a wave."""
    top = first_top(velocity)
    if top is None:
        return None
    half = 0.5 * velocity[top]
    after = int(np.argmax(velocity >= half))
    if after == 0:
        return None
    part = (half - velocity[after - 1]) / (velocity[after] - velocity[after - 1])
    return float(time[after - 1] + part * (time[after] - time[after - 1]))


def pull_back(time, velocity):
    """Returns (fall of the velocity of a free end from its maximum to the minimum that the wave of a crack ends, time between
    them), None if it does not rebound."""
    top = lowest = int(np.argmax(velocity))
    for i in range(top, len(velocity)):
        fall = velocity[top] - velocity[lowest]
        if velocity[i] < velocity[lowest]:
            lowest = i
        elif fall > FALL * velocity[top] and velocity[i] - velocity[lowest] > REBOUND * velocity[top]:
            return float(fall), float(time[lowest] - time[top])
    return None


def opening_work(force, opening):
    """Returns (work of a tension on an opening, part of the peak that is left at its end). The work begins where the tension of the
    peak begins and ends where it has fallen to OPENED of the peak, so that the elastic part of the opening has gone back as well; if
    it does not fall so far, at the end."""
    peak = int(np.argmax(force))
    begin = peak
    while begin > 0 and force[begin] > 0:
        begin -= 1
    below = np.nonzero(force[peak:] <= OPENED * force[peak])[0]
    end = peak + int(below[0]) if below.size else len(force) - 1
    means = 0.5 * (force[begin:end] + force[begin + 1:end + 1])
    return float(means @ np.diff(opening[begin:end + 1])), 0.0 if below.size else float(force[-1] / force[peak])


def count_cracks(gaps, works):
    """Returns how many of the planes beside one another are cracks of their own (SAME), at least 1. gaps: how wide they are; works:
    of the tension on each, both n. A bar that breaks in several planes at once has several fracture surfaces."""
    walled = np.concatenate([[-np.inf], gaps, [-np.inf]])
    widest = (gaps >= walled[:-2]) & (gaps > walled[2:])
    return max(1, int(np.count_nonzero(widest & (works >= SAME * works[np.argmax(gaps)]))))


def spall(bar, wave_speed):
    """Evaluates a bar whose upper end is free and which a pulse enters from below. wave_speed: of long waves in the bar, c_0;
    the strength is that of Novikov, density c_0 (v_max - v_min) / 2."""
    end, diameter = bar.velocity[:, -1], 2 * np.sqrt(bar.area / np.pi)
    layers, spacing = len(bar.place), float(np.mean(np.diff(bar.place)))
    stress = [bar.force_below(layer) / bar.area for layer in range(layers)]
    back = pull_back(bar.time, end)
    gauge = max(1, round(0.5 * GAUGE * diameter / spacing))
    # The plane with the widest gap between two layers, ends aside, where a force has no room to act.
    inner = np.arange(3, layers - 2)
    gaps = bar.displacement[-1, inner] - bar.displacement[-1, inner - 1]
    plane = int(inner[np.argmax(gaps)])
    low, high = max(plane - 1 - gauge, 0), min(plane + gauge, layers - 1)
    # Without the elastic strain, in which waves run to and fro.
    elastic = spacing / (bar.density * wave_speed**2) * np.array(stress)
    openings = [bar.displacement[:, i] - bar.displacement[:, i - 1] - elastic[i] for i in range(low + 1, high + 1)]
    opening = np.sum(openings, axis=0)
    work, left = opening_work(stress[plane], opening)
    works = [opening_work(stress[low + 1 + i], one)[0] for i, one in enumerate(openings)]
    cracks = count_cracks(np.array([one[-1] for one in openings]), np.array(works))
    near = max(1, layers - round(diameter / spacing))
    return Spall(bar.wave_speed(), -float(np.min(stress[layers // 10])), -float(np.min(stress[near])),
                 float(np.max(end)),
                 None if back is None else 0.5 * bar.density * wave_speed * back[0],
                 None if back is None else back[0] / (2 * wave_speed * back[1]),
                 float(bar.place[-1] - bar.place[plane] + spacing), float(np.max(stress[plane])), float(opening[-1]),
                 cracks, work / cracks, left)


def pull(time, opening, momentum, area, length):
    """Evaluates a bar between two heavy ends. opening: of the ends; momentum: that they have lost, the mean of both."""
    stress = np.gradient(momentum, time) / area
    work, left = opening_work(stress, opening)
    rate = (opening[-1] - opening[0]) / (time[-1] - time[0]) / length
    return Pull(float(np.max(stress)), float(rate), float(opening[-1]), work, left)


def split(time, closing, momentum, height, depth):
    """Evaluates a cube between two heavy strips. closing: of the strips; momentum: that they have lost, the mean of both; height
    and depth: of the plane between the strips."""
    force = np.gradient(momentum, time)
    top = int(np.argmax(force))
    return Split(float(2 * force[top] / (np.pi * height * depth)), float(closing[top]), float(force[-1] / force[top]))
