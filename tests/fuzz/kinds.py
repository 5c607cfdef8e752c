"""Kinds of input by name, with how often they come.

Each is a function of a bench and a random generator that returns what the input is, and an action that reads it: what that
accepts must be finite and physical, or it raises `Absurd`. Everything is made from the generator, so that a case comes again from
its seed and number.
"""

import kinds_of_arguments as arguments
import kinds_of_files as files

KINDS = {
    "units": (arguments.units, 40),
    "condition": (arguments.condition, 40),
    "wake": (arguments.wake, 20),
    "maneuver": (arguments.maneuver, 40),
    "maneuver file": (files.maneuver_file, 25),
    "aircraft file": (files.aircraft_file, 3),
    "table file": (files.table_file, 3),
    "rotor file": (files.rotor_file, 15),
    "c81 deck": (files.deck, 15),
    "result file": (files.result_file, 4),
    "snapshot": (files.snapshot, 10),
    "call": (arguments.call, 12),
    "command": (arguments.command, 1.5),
    "page": (arguments.page, 0.02),
}
