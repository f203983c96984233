"""Places on a logarithmic scale."""

from bisect import bisect_left


def nearest(ratios: list[float], wanted: float) -> float:
    """The entry nearest to `wanted`, on the logarithmic scale of the slider."""
    at = min(max(bisect_left(ratios, wanted), 1), len(ratios) - 1)
    low, high = ratios[at - 1], ratios[at]
    return low if wanted * wanted <= low * high else high
