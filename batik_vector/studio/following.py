"""The page follows a recipe's file: what is saved in any editor is shown, and what is wrong with it told."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

from batik_vector.errors import BatikError
from batik_vector.studio.drafts import Draft
from batik_vector.studio.watching import PERIOD, Watched

if TYPE_CHECKING:
    from batik_vector.studio.page.session import Session


async def follow(session: Session, watched: Watched) -> None:
    """Show what a recipe's file says each time that it, or what it names, has been saved; without end."""
    while True:
        await asyncio.sleep(PERIOD)
        if not watched.changed():
            continue
        await asyncio.to_thread(watched.settled)
        watched.seen()
        try:
            draft = await asyncio.to_thread(Draft.read, watched.source)
        except BatikError:
            # It is gone, or no text: the page keeps what it has until it is there again.
            continue
        session.follow(draft)
