# SPDX-License-Identifier: MIT OR Apache-2.0
"""What steadies the helicopter in a cockpit without feel: holding attitude where the stick is, damping, coordinated turns.

Structures from textbooks, gains of our own that suit helicopters of the UH-60A's and the BO 105's kind: no system of an aircraft.
"""

from __future__ import annotations

from ..control import AttitudeHold, Augmentation, RateDamping, TurnCoordination


def steady() -> Augmentation:
    """Attitude follows the cyclic: an inch is some ten degrees."""
    return Augmentation(
        (
            AttitudeHold(
                roll="5 in/rad",
                roll_rate="2 in/(rad/s)",
                pitch="7 in/rad",
                pitch_rate="5 in/(rad/s)",
                authority="40 %",
            ),
            RateDamping(yaw="3 in/(rad/s)", washout="3 s", authority="30 %"),
            TurnCoordination(yaw_rate="2 in/(rad/s)", sideslip="1 in/rad", authority="20 %"),
        )
    )
