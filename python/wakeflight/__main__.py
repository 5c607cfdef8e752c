# SPDX-License-Identifier: MIT OR Apache-2.0
"""`python -m wakeflight` is the command line."""

from .cli import main

main()
