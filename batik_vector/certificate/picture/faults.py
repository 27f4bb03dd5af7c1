"""What is told of the joints of a seam: the faults, and the ink that ends along the edges by design."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import shapely

from batik_vector.certificate.picture.bodies import Bodies
from batik_vector.certificate.picture.joints import Cause, Joint, Joints
from batik_vector.certificate.report import EdgeStretch, Kind, SeamFault
from batik_vector.certificate.seam import EDGE_NAMES, Seam
from batik_vector.units import format_mm

KINDS = {Cause.ORDER: Kind.ORDER, Cause.TINT: Kind.TINT, Cause.RAMP: Kind.TINT}


def joint_fault(joint: Joint, seam: Seam, bodies: Bodies) -> SeamFault:
    """Say in words what is wrong at a joint."""
    size = (joint.high - joint.low) / seam.frame.per_mm
    ink = bodies.paints[bodies.paint[joint.body]].ink if joint.body >= 0 else ""
    near_is_covered = joint.near == joint.body or (joint.near >= 0 and joint.far < 0)
    place = seam.place((joint.low + joint.high) / 2, joint.cause == Cause.CUT and not near_is_covered)
    return SeamFault(KINDS.get(joint.cause, Kind.UNPAIRED), ink, place, _words(joint, seam, bodies), size)


def _words(joint: Joint, seam: Seam, bodies: Bodies) -> str:
    edges = EDGE_NAMES[seam.axis]
    here, there = (_spread(joint, seam, far) for far in (False, True))
    if joint.cause == Cause.ORDER:
        near, far = (_look(body, bodies) for body in (joint.near, joint.far))
        sides = f"{near} at the {edges[0]} edge {here}, {far} at the {edges[1]} edge {there}"
        return f"what lies on top differs: {sides}"
    if joint.cause == Cause.RAMP:
        return f"a colour that runs jumps from the {edges[0]} edge {here} to the {edges[1]} edge {there}"
    if joint.cause == Cause.NICK:
        where = seam.at(joint.low if joint.low % seam.length else joint.high, joint.near < 0)
        return (
            f"a line that comes in aslant ends flat at {where}, and leaves a nick: draw it on beyond the edge"
        )
    if joint.cause == Cause.TINT:
        near, far = (_look(body, bodies, tint=True) for body in (joint.near, joint.far))
        return f"two tints meet: {near} at the {edges[0]} edge {here}, {far} at the {edges[1]} edge {there}"
    return _cut_words(joint, seam, bodies)


def _cut_words(joint: Joint, seam: Seam, bodies: Bodies) -> str:
    edges = EDGE_NAMES[seam.axis]
    far = joint.near != joint.body and (joint.far == joint.body or joint.near < 0)
    mine, other = (joint.far, joint.near) if far else (joint.near, joint.far)
    size = (joint.high - joint.low) / seam.frame.per_mm
    breadth = float(bodies.breadth[joint.body]) if joint.body >= 0 else 0.0
    lost = _beyond(joint, seam, bodies, far)
    covered = f"the {edges[far]} edge {_spread(joint, seam, far)}"
    bare = f"the {edges[not far]} edge {_spread(joint, seam, not far)}"
    if breadth and 0 < lost < breadth:
        return (
            f"{format_mm(lost)} of the {format_mm(breadth)} mm of a line's breadth are cut off at {covered}, "
            f"and do not come back at {bare}"
        )
    goes_on = f"shows {_look(other, bodies)}" if other >= 0 else "is bare"
    what = _look(mine, bodies) if mine >= 0 else "nothing"
    return f"{format_mm(size)} mm of {what} end at {covered}, and {bare} {goes_on}"


def _beyond(joint: Joint, seam: Seam, bodies: Bodies, far: bool) -> float:
    """Return how far (mm) the body to blame reaches beyond the page."""
    if joint.body < 0:
        return 0.0
    bounds = shapely.bounds(bodies.shapes[joint.body])
    value = (seam.far if far else seam.near) / seam.frame.per_mm
    return float(max(bounds[seam.axis + 2] - value if far else value - bounds[seam.axis], 0.0))


def _spread(joint: Joint, seam: Seam, far: bool) -> str:
    low, high = _places(joint, seam, far)
    return f"at {'yx'[seam.axis]} = {format_mm(low)} to {format_mm(high)}"


def _places(joint: Joint, seam: Seam, far: bool) -> tuple[float, float]:
    low = seam.place(joint.low, far)[1 - seam.axis]
    return low, low + (joint.high - joint.low) / seam.frame.per_mm


def _look(body: int, bodies: Bodies, tint: bool = False) -> str:
    if body < 0:
        return "nothing"
    paint = bodies.paints[bodies.paint[body]]
    return f"{paint.ink} at {100 * paint.opacity:.3g} %" if tint else paint.ink


def stretches(found: Iterable[Joints], bodies: Bodies) -> tuple[EdgeStretch, ...]:
    """Return the ink that ends along the edges by design, edge by edge."""
    told: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for each in found:
        for joint in each.joints:
            for body, far in joint.ending if joint.meant else ():
                key = EDGE_NAMES[each.seam.axis][far], _look(body, bodies)
                told.setdefault(key, []).append(_places(joint, each.seam, far))
    return tuple(
        EdgeStretch(edge, ink, low, high)
        for (edge, ink), places in told.items()
        for low, high in _merged(places)
    )


def _merged(places: list[tuple[float, float]]) -> Iterator[tuple[float, float]]:
    """Yield stretches, those that touch as one."""
    low, high = -1.0, -1.0
    for a, b in sorted(places):
        if low >= 0 and a <= high + 1e-6:
            high = max(high, b)
            continue
        if low >= 0:
            yield low, high
        low, high = a, b
    if low >= 0:
        yield low, high
