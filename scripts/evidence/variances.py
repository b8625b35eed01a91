"""Errors whose variance is a sum of known parts with unknown weights: the weights by maximum likelihood.

e_i ~ N(0, f_i + Σ_j w_j · x_ij) with w_j ≥ 0 and f_i known. The step of Zhou, Hu, Zhou and Lange, "MM algorithms for variance components models", JCGS 2019,
multiplies each weight by sqrt(Σ_i x_ij e_i² / v_i² / Σ_i x_ij / v_i): the likelihood never falls, no weight becomes negative.
A row is (e, [x_1, x_2, …], f).
"""
import math
import random

STEPS = 300
SETTLED = 1e-4  # relative change of every weight
TRIALS = 100
LEAST_VARIANCE = 1e-12


def variance(parts, weights, known):
    return max(LEAST_VARIANCE, known + sum(w * x for w, x in zip(weights, parts)))


def fit(rows, start):
    """The weights; `start` gives their number, and none of it may be zero: such a weight stays so."""
    weights = [max(w, LEAST_VARIANCE) for w in start]
    for _ in range(STEPS):
        above, below = [0.0] * len(weights), [0.0] * len(weights)
        for error, parts, known in rows:
            v = variance(parts, weights, known)
            for j, x in enumerate(parts):
                above[j] += x * (error / v) ** 2
                below[j] += x / v
        factors = [math.sqrt(a / b) if b > 0 else 1 for a, b in zip(above, below)]
        weights = [w * factor for w, factor in zip(weights, factors)]
        if all(abs(factor - 1) < SETTLED for factor in factors):
            break
    return weights


def nees(rows, weights):
    """Mean squared error over the variance: 1 where it is honest."""
    return sum(error ** 2 / variance(parts, weights, known) for error, parts, known in rows) / len(rows)


def with_intervals(groups, start, trials=TRIALS, seed=1):
    """[(estimate, low, high)] with 95 % of a bootstrap over the groups: errors of one flight are not independent."""
    draw = random.Random(seed)
    best = fit([row for group in groups for row in group], start)
    again = [fit([row for group in draw.choices(groups, k=len(groups)) for row in group], best) for _ in range(trials)]
    columns = [sorted(column) for column in zip(*again)]
    at = lambda column, share: column[min(len(column) - 1, int(share * len(column)))]
    return [(w, at(column, 0.025), at(column, 0.975)) for w, column in zip(best, columns)]
