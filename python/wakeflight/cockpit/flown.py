# SPDX-License-Identifier: MIT OR Apache-2.0
"""A session with its server: what `wakeflight cockpit` starts."""

from __future__ import annotations

import webbrowser
from pathlib import Path

from ..progress import Progress, Silent
from .server import Server
from .session import Session, Setup


def cockpit(setup: Setup, port: int, browse: bool, progress: Progress | Silent) -> list[Path]:
    """Fly until the pilot or a signal ends the session; returns the runs that were written.

    port: 0 for any that is free. browse: open the page in a browser.
    """
    session = Session(setup, progress)
    server = Server(session.say, session.models, port)
    session.publish = server.publish
    try:
        session.prepare()
        progress(f"cockpit: {server.url}")
        if browse:
            webbrowser.open(server.url)
        session.run()
    finally:
        server.close()
    return session.runs
