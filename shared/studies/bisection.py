"""Where a yes turns into a no: bisection with answers that may be missing. No runs here."""

from dataclasses import dataclass

# Places of a step within the bracket: the middle, and others where the middle has no answer.
PLACES = (0.5, 0.35, 0.65, 0.25, 0.75)


class NoLimit(Exception):
    """Its message says why there is no limit between the ends."""


@dataclass(frozen=True)
class Bracket:
    """The largest place with the answer of the low end, and the smallest one with that of the high end."""

    low: float
    high: float

    @property
    def middle(self):
        return 0.5 * (self.low + self.high)


def bisect(ask, low, high, width):
    """Returns (Bracket no wider than `width`, answer at its high end). ask: x -> True, False, or None without an answer.
    @raises NoLimit if both ends have one answer, if one has none, or if no place within the bracket has one"""
    ends = ask(low), ask(high)
    for x, answer in zip((low, high), ends):
        if answer is None:
            raise NoLimit(f"no answer at {x:g}")
    if ends[0] == ends[1]:
        raise NoLimit(f"the answer at {low:g} is that at {high:g}: {'yes' if ends[0] else 'no'}")
    while high - low > width:
        for place in PLACES:
            x = low + place * (high - low)
            if (answer := ask(x)) is not None:
                break
        else:
            raise NoLimit(f"no answer between {low:g} and {high:g}")
        low, high = (low, x) if answer == ends[1] else (x, high)
    return Bracket(low, high), ends[1]


def narrowest(known, low, high, rises):
    """Returns the narrowest ends (low, high) that known answers leave. known: {x: True, False or None}; rises: whether larger x have
    the answer yes. Where answers contradict the order, the
    first change from below counts."""
    for x in sorted(x for x, answer in known.items() if answer is not None and low <= x <= high):
        if known[x] == rises:
            return low, x
        low = x
    return low, high


def disorder(known, rises):
    """Returns (first, last) places of the range in which both answers occur out of order, None if there is none."""
    yes = [x for x, answer in known.items() if answer is rises]
    no = [x for x, answer in known.items() if answer is (not rises)]
    return (min(yes), max(no)) if yes and no and min(yes) < max(no) else None
