"""What comes and goes as files: pictures, thumbnails, downloads, and what is dropped."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import quote

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
            data = await session.shelf.picture(request.query_params.get("name", ""))
        except BatikError as error:
            return Response(f"{error}\n", 404, media_type="text/plain")
        # A version never changes.
        kind = "image/png" if data.startswith(b"\x89PNG") else "image/svg+xml"
        return Response(data, media_type=kind, headers={"cache-control": "max-age=86400"})

    async def drop(request: Request) -> Response:
        try:
            words = await session.drop(request.query_params.get("name", ""), await request.body())
        except BatikError as error:
            return Response(str(error), 422, media_type="text/plain")
        return Response(words, media_type="text/plain")

    async def download(request: Request) -> Response:
        name, data = session.files.get(request.path_params["number"], ("", b""))
        if not name:
            return Response("gone\n", 404)
        headers = NOT_KEPT | {"content-disposition": f"attachment; filename*=UTF-8''{quote(name)}"}
        return Response(data, media_type="application/octet-stream", headers=headers)

    app.add_route("/studio/drop", drop, methods=["POST"])
    app.add_route("/studio/download/{number:int}", download)
    app.add_route("/studio/picture/{number:int}", picture)
    app.add_route("/studio/thumbnail", thumbnail)
