"""Tip-vortex centres of the HART II baseline."""

from hart2 import BASELINE, vortices


def run(case):
    return vortices(case, BASELINE)
