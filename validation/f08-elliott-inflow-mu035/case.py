"""Induced inflow above the disk at an advance ratio of 0.35."""

from elliott import compare


def run(case):
    return compare(case, speed=66.75, shaft_angle=-5.7, controls=(9.2, 0.3, -6.8), tolerance=0.007)
