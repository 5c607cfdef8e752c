"""Tip-vortex centres of the HART II minimum-noise case, with higher-harmonic pitch."""

from hart2 import MINIMUM_NOISE, vortices


def run(case):
    return vortices(case, MINIMUM_NOISE)
