"""What comes and goes as files: pictures, thumbnails, downloads, and what is dropped."""

from __future__ import annotations

from typing import TYPE_CHECKING

from starlette.requests import Request
from starlette.responses import Response

from batik_vector.errors import BatikError

if TYPE_CHECKING:
    from fastapi import FastAPI

    from batik_vector.studio.page.session import Session

NOT_KEPT = {"cache-control": "no-store"}


def add_routes(app: FastAPI, session: Session) -> None:
    """Add the addresses at which files come and go."""

    async def picture(request: Request) -> Response:
        svg = session.pictures.get(request.path_params["number"])
        if svg is None:
            return Response("gone", 404)
        return Response(svg, media_type="image/svg+xml", headers=NOT_KEPT)

    async def thumbnail(request: Request) -> Response:
        try:
            svg = await session.shelf.picture(request.query_params.get("name", ""))
        except BatikError as error:
            return Response(f"{error}\n", 404, media_type="text/plain")
        # A version never changes.
        return Response(svg, media_type="image/svg+xml", headers={"cache-control": "max-age=86400"})

    app.add_route("/studio/picture/{number:int}", picture)
    app.add_route("/studio/thumbnail", thumbnail)
