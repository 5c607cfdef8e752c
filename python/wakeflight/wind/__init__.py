# SPDX-License-Identifier: MIT OR Apache-2.0
"""Air that moves of its own: steady wind, gusts, turbulence, measured or computed fields; what it is where an aircraft feels it.

A wind is asked at points (n, 3) [m] in inertial axes (north, east, down from where the flight begins) at a time [s] and answers
with the velocity of the air there (n, 3) [m/s]. It depends on points and time alone, so that a flight that is kept goes on in the
same air; the aircraft flies through it, and blades meet what is where they are.
"""

from .._core import Air
from .field import WindField
from .gust import Gust
from .kinds import SteadyWind, Wind, Winds
from .made import wind_from_text, wind_of, wind_of_table
from .surroundings import Surroundings, passing
from .turbulence import Dryden, VonKarman

__all__ = [
    "Air",
    "Dryden",
    "Gust",
    "SteadyWind",
    "Surroundings",
    "VonKarman",
    "Wind",
    "WindField",
    "Winds",
    "passing",
    "wind_from_text",
    "wind_of",
    "wind_of_table",
]
