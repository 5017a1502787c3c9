"""Distributions of uncertain inputs: how a line of a study is read, and which value belongs to a place in (0, 1).

A value is the quantile of its distribution at a place u, with the unit of the line behind the number."""

import math
import pathlib
from dataclasses import dataclass, replace
from statistics import NormalDist

from study_file import fault_of_file

FAR = 0.999  # place of the end of a distribution that has none: a value beyond it is found in one of a thousand samples
FORMS = {"uniform": "uniform LOW HIGH [UNIT] with LOW < HIGH",
         "triangular": "triangular LOW MODE HIGH [UNIT] with LOW <= MODE <= HIGH and LOW < HIGH",
         "normal": "normal MEAN SD [UNIT] truncated NUMBER SD, or truncated LOW HIGH; SD > 0",
         "lognormal": "lognormal MEDIAN FACTOR [UNIT], and if wanted truncated NUMBER SD or truncated LOW HIGH; MEDIAN > 0, "
                      "FACTOR > 1",
         "integers": "integers LOW HIGH with LOW < HIGH",
         "choice": "choice A | B ..., each with ` weight NUMBER` behind it if wanted"}
COUNTS = {"uniform": 2, "triangular": 3, "normal": 2, "lognormal": 2, "integers": 2}


@dataclass(frozen=True)
class Law:
    """A distribution of numbers. quantile: place -> number; unit: that of the number, or nothing."""
    words: str
    quantile: object
    unit: str = ""
    ends: tuple = (0.0, 1.0)  # places that bound what is likely

    def text(self, u):
        number = self.quantile(u)
        return f"{number}" if isinstance(number, int) else f"{number:.10g}" + (f" {self.unit}" if self.unit else "")


@dataclass(frozen=True)
class Choice:
    """One of several texts, with weights that add up to 1."""
    words: str
    values: tuple   # one tuple per alternative, with a text for each key
    shares: tuple

    def index(self, u):
        """Returns the number of the alternative at a place, from 0."""
        reached = 0.0
        for i, share in enumerate(self.shares):
            reached += share
            if u < reached:
                return i
        return len(self.shares) - 1


@dataclass(frozen=True)
class Uncertain:
    """An uncertain input: one draw that sets one key or several."""
    name: str
    keys: tuple
    laws: tuple  # one Law for all keys, one for each, or a Choice
    line: object  # where the study sets it

    @property
    def is_choice(self):
        return isinstance(self.laws[0], Choice)

    @property
    def has_order(self):
        """Whether larger values can be told from smaller ones. The numbers of random seeds say nothing."""
        return not self.is_choice and not all(key.lower().endswith("seed") for key in self.keys)

    def texts(self, u):
        """Returns the value of each key at a place."""
        if self.is_choice:
            return self.laws[0].values[self.laws[0].index(u)]
        return tuple(law.text(u) for law in (self.laws if len(self.laws) > 1 else self.laws * len(self.keys)))

    def settings(self, u):
        return dict(zip(self.keys, self.texts(u)))

    def number(self, u):
        """Returns a number that rises with the value: that of the first key; of a choice the number of the alternative."""
        return self.laws[0].index(u) if self.is_choice else self.laws[0].quantile(u)

    def columns(self, u):
        """Returns {title: text} for a table: numbers under a title with their unit, alternatives as they are."""
        if self.is_choice:
            return {self.name: ", ".join(self.texts(u))}
        found = {}
        for key, law in zip(self.keys, self.laws):
            title = (self.name if len(self.laws) == 1 else f"{self.name} {key}") + (f" ({law.unit})" if law.unit else "")
            found[title] = law.text(u).removesuffix(f" {law.unit}")
        return found

    def ends(self):
        """Returns the settings at the ends of what is likely, or of every alternative."""
        if self.is_choice:
            return [dict(zip(self.keys, values)) for values in self.laws[0].values]
        return [dict(zip(self.keys, texts)) for texts in zip(*(
            [law.text(u) for u in law.ends] for law in (self.laws if len(self.laws) > 1 else self.laws * len(self.keys))))]


def beside(one, folder):
    """Returns an uncertain input whose alternatives name files, if they are there, as beside the study: relative to its folder."""
    if not one.is_choice:
        return one
    found = one.laws[0]
    values = tuple(tuple(str(folder / word) if not fault_of_file(folder / word) else word for word in words) for words in found.values)
    return replace(one, laws=(replace(found, values=values),))


def files_of(inputs):
    """Returns the files that alternatives of the inputs name, such as damage tables: runs depend on what they hold."""
    named = [pathlib.Path(word) for one in inputs if one.is_choice for values in one.laws[0].values for word in values]
    return sorted({path for path in named if not fault_of_file(path)})


def read(name, value, line):
    """Reads `Section/Key=DISTRIBUTION` or `Section/Key + Section/Key=DISTRIBUTION[, DISTRIBUTION]`. @raises ValueError"""
    left, equals, right = value.partition("=")
    keys = tuple(key.strip() for key in left.split(" + "))
    if not equals or not all("/" in key and not key.startswith("/") and not key.endswith("/") for key in keys):
        raise ValueError(f"found '{value}', allowed: Section/Key=DISTRIBUTION, or Section/Key + Section/Key=DISTRIBUTION")
    if len(set(keys)) < len(keys):
        raise ValueError(f"found '{left.strip()}', allowed: keys that differ")
    kind, _, rest = right.strip().partition(" ")
    if kind == "choice":
        return Uncertain(name, keys, (choice(right.strip(), rest, len(keys)),), line)
    laws = tuple(law(word.strip()) for word in right.split(","))
    if len(laws) not in (1, len(keys)):
        raise ValueError(f"found {len(laws)} distributions between commas, allowed: 1" +
                         (f", or {len(keys)} as there are keys" if len(keys) > 1 else ""))
    return Uncertain(name, keys, laws, line)


def choice(words, text, count):
    """Reads `A | B weight 2 | C`; with several keys each alternative has as many values between commas. @raises ValueError"""
    values, weights = [], []
    for alternative in text.split("|"):
        alternative, _, weight = alternative.strip().partition(" weight ")
        values.append(tuple(word.strip() for word in alternative.split(",")) if count > 1 else (alternative.strip(),))
        weights.append(finite(weight) if weight else 1.0)
    if len(values) < 2 or not all(word for found in values for word in found) or not all(
            weight is not None and weight > 0 for weight in weights):
        raise ValueError(f"found '{words}', allowed: {FORMS['choice']}; weights > 0")
    if any(len(found) != count for found in values):
        raise ValueError(f"found '{words}', allowed: {count} values between commas in each alternative")
    if len(set(values)) < len(values):
        raise ValueError(f"found '{words}', allowed: alternatives that differ")
    return Choice(words, tuple(values), tuple(weight / sum(weights) for weight in weights))


def finite(word):
    """Returns the finite number in a word, or None."""
    try:
        number = float(word)
    except ValueError:
        return None
    return number if math.isfinite(number) else None


def law(text):
    """Reads a distribution of numbers. @raises ValueError"""
    text = " ".join(text.split())
    kind = text.split(" ")[0]
    if kind not in COUNTS:
        raise ValueError(f"found '{text}', allowed: {', '.join(FORMS)}, with numbers behind it")
    body, _, limits = text.partition(" truncated ")
    words = body.split()[1:]
    numbers = [finite(word) for word in words[:COUNTS[kind]]]
    unit = " ".join(words[COUNTS[kind]:])
    made = None
    if len(numbers) == COUNTS[kind] and None not in numbers and finite(unit.split(" ")[0]) is None:
        made = MAKERS[kind](text, numbers, unit, limits.split())
    if made is None:
        raise ValueError(f"found '{text}', allowed: {FORMS[kind]}")
    return made


# The makers return None where the numbers are not allowed.


def uniform(text, numbers, unit, limits):
    low, high = numbers
    return Law(text, lambda u: low + u * (high - low), unit) if low < high and not limits else None


def triangular(text, numbers, unit, limits):
    low, mode, high = numbers
    if not low <= mode <= high or not low < high or limits:
        return None

    def quantile(u):
        if u * (high - low) < mode - low:
            return low + math.sqrt(u * (high - low) * (mode - low))
        return high - math.sqrt((1 - u) * (high - low) * (high - mode))

    return Law(text, quantile, unit)


def integers(text, numbers, unit, limits):
    if not all(number == int(number) for number in numbers) or not numbers[0] < numbers[1] or unit or limits:
        return None
    low, high = (int(number) for number in numbers)
    return Law(text, lambda u: min(high, low + int(u * (high - low + 1))))


def normal(text, numbers, unit, limits):
    mean, deviation = numbers
    if deviation <= 0:
        return None
    places = truncation(limits, lambda x: (x - mean) / deviation)
    return Law(text, lambda u: mean + deviation * standard(u, places), unit) if places else None


def lognormal(text, numbers, unit, limits):
    """FACTOR is the exponential of the standard deviation of the logarithm: two thirds lie within MEDIAN / FACTOR and MEDIAN
    FACTOR."""
    median, factor = numbers
    if median <= 0 or factor <= 1:
        return None
    spread = math.log(factor)
    places = truncation(limits, lambda x: math.log(x / median) / spread if x > 0 else None) if limits else (0.0, 1.0)
    if not places:
        return None
    ends = (0.0, 1.0) if limits else (1 - FAR, FAR)
    return Law(text, lambda u: median * math.exp(spread * standard(u, places)), unit, ends)


MAKERS = {"uniform": uniform, "triangular": triangular, "integers": integers, "normal": normal, "lognormal": lognormal}


def truncation(limits, standardised):
    """Returns the probabilities below the two limits of `truncated NUMBER SD` or `truncated LOW HIGH`; None if they are neither.
    standardised: number -> standard deviations above the mean, or None."""
    if len(limits) != 2:
        return None
    low, high = (finite(word) for word in limits)
    if limits[1] == "SD":
        ends = (-low, low) if low is not None and 0 < low <= 8 else (None, None)
    else:
        ends = (None, None) if None in (low, high) else (standardised(low), standardised(high))
    if None in ends or not ends[0] < ends[1]:
        return None
    found = tuple(NormalDist().cdf(end) for end in ends)
    return found if found[0] < found[1] else None


def standard(u, places):
    """Returns the quantile of the standard normal distribution between two probabilities; at most 8.3 standard deviations."""
    p = places[0] + u * (places[1] - places[0])
    return NormalDist().inv_cdf(min(max(p, 1e-16), 1 - 2**-53))
