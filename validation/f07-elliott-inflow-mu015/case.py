"""Induced inflow above the disk at an advance ratio of 0.15."""

from elliott import compare


def run(case):
    return compare(case, speed=28.5, shaft_angle=-3.0, controls=(9.37, 1.11, -3.23), tolerance=0.010)
