"""Whether a page shows what a command prints: words alike, numbers as far as their digits are certain."""

import re

_NUMBER = re.compile(r"[-+−]?\d+(?:\.\d*)?(?:e[-+]?\d+)?")
# Seconds and memory differ from run to run, cells and unknowns from one release of gmsh to the next.
_COUNTS = re.compile(r"\d+(?= (?:cells|unknowns))")
_COST = re.compile(r"seconds: [^;]*; peak memory \d+ MiB")
_RULE = re.compile(r"─+")
_GAP = re.compile(r"(?:^|(?<=\s))\.\.\.(?=\s|$)")
# An estimated error follows the mesh, and the mesh the release of gmsh.
_ERRORS_ALIKE = 3.0


def is_shown(shown: str, printed: str) -> bool:
    """Whether the passages of what is shown, with three points between them, are all in what is printed, in order.

    Line breaks, blanks and rules do not count, nor what a run takes. A number with a point may differ by one
    unit of its last digit, an estimated error such as 2.4e-09 by a factor of three.
    """
    words = _words(printed)
    place = 0
    for passage in map(_words, _GAP.split(shown)):
        starts = range(place, len(words) - len(passage) + 1)
        found = next((start for start in starts if _alike(passage, words[start : start + len(passage)])), None)
        if found is None:
            return False
        place = found + len(passage)
    return True


def _words(text: str) -> list[str]:
    words = " ".join(_RULE.sub(" ", text).split())
    return _COUNTS.sub("…", _COST.sub("seconds: …", words)).split()


def _alike(shown: list[str], printed: list[str]) -> bool:
    return all(map(_word_alike, shown, printed))


def _word_alike(shown: str, printed: str) -> bool:
    if shown == printed:
        return True
    if _NUMBER.sub("#", shown) != _NUMBER.sub("#", printed):
        return False
    return all(map(_number_alike, _NUMBER.findall(shown), _NUMBER.findall(printed)))


def _number_alike(shown: str, printed: str) -> bool:
    one, other = (float(text.replace("−", "-")) for text in (shown, printed))
    if "e-" in shown and "e-" in printed and one * other > 0.0:
        return 1.0 / _ERRORS_ALIKE <= one / other <= _ERRORS_ALIKE
    if shown.lstrip("-+−").isdigit() and printed.lstrip("-+−").isdigit():
        return one == other
    # Rounded to their last digits, numbers that are next to each other differ by a unit, and by rounding.
    return abs(one - other) <= 1.001 * max(_last_digit(shown), _last_digit(printed))


def _last_digit(text: str) -> float:
    mantissa, _, exponent = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)
