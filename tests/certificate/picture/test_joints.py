"""What a stranger's tile shows at its seams: what ends there by design, and what the page cuts off."""

from __future__ import annotations

import pytest

from batik_vector.certificate import Certificate, Kind, certify
from batik_vector.command.checks import Wishes
from batik_vector.importing.svg import read_svg

BLUE, RED, GROUND = "#1d2f5f", "#a83232", "#f4efe2"


def found(body: str, repeat: str = "grid", size: str = "60 60", **limits: float) -> Certificate:
    width, height = size.split()
    text = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" '
        f'viewBox="0 0 {width} {height}" fill="{BLUE}">{body}</svg>'
    )
    reading = read_svg(text.encode(), repeat)
    return certify(
        reading.artwork,
        limits=Wishes(limits=limits).limits_for(foreign=True),
        bodies=reading.bodies,
        unmeasured=reading.unmeasured,
        remarked=(Kind.DOUBLE,),
    )


def edges(certificate: Certificate) -> list[tuple[str, float, float]]:
    return sorted((each.edge, round(each.low, 3), round(each.high, 3)) for each in certificate.along)


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ('<path d="M0 10h60v8H0zM0 0h60v4H0z"/>', [("upper", 0, 60)]),
        ('<path d="M0 10h20v8H0z"/>', [("left", 42, 50)]),
        # A bar against a bar in another ink, in register.
        (
            f'<path d="M0 10h20v8H0z"/><path fill="{RED}" d="M40 10h20v8H40z"/>',
            [("left", 42, 50), ("right", 42, 50)],
        ),
        # The same half diamond stands inside the tile too.
        ('<path d="M0 10l9 9-9 9zM30 10l9 9-9 9z"/>', [("left", 32, 50)]),
        # A rod from disc to disc lies beside the edge: as it meets them there, it does on its other side.
        ('<path d="M0 10.101A5 5 0 0 1 2 19.899V40.172A3 3 0 0 1 0 45.828z'
         'M60 10.101A5 5 0 0 0 60 19.899zM60 40.172A3 3 0 0 0 60 45.828z"/>', [("left", 20, 40)]),
        # Rounded corners leave the edge along it.
        ('<rect width="40" height="20" y="20" rx="5"/>', [("left", 25, 35)]),
        # A line that comes in squarely may end there.
        (f'<path d="M0 10h20" stroke="{BLUE}" stroke-width="2" stroke-linecap="round"/>', [("left", 49, 51)]),
        # The page may be all ground, or hold one that is larger than itself.
        (f'<rect x="-9" y="-9" width="99" height="99" fill="{GROUND}"/><path d="M0 10h20v8H0z"/>',
         [("left", 42, 50)]),
    ],
)  # fmt: skip
def test_ink_that_ends_along_the_edge_by_design_is_told(
    body: str, told: list[tuple[str, float, float]]
) -> None:
    certificate = found(body)
    assert certificate.faults == ()
    for edge, low, high in told:
        assert any(
            each == edge and abs(a - low) <= 0.2 and abs(b - high) <= 0.2 for each, a, b in edges(certificate)
        ), edges(certificate)


@pytest.mark.parametrize(
    ("body", "kind", "words"),
    [
        # The page cuts a disc, and nothing comes back.
        ('<circle cy="30" r="9"/>', Kind.UNPAIRED, "covered at the left edge"),
        # A half of one, large enough for a chord to look like a straight piece; another ink is a line alone.
        (f'<path d="M0 10a20 20 0 0 1 0 40z"/><path d="M20 5h9" stroke="{RED}"/>', Kind.UNPAIRED,
         "covered at the left edge"),
        # A half that was cut before: curves that end at the page, aslant.
        ('<path d="M0 14A20 20 0 0 1 0 46z"/>', Kind.UNPAIRED, "covered at the left edge"),
        ('<path d="M0 10l9 12-9 9z"/>', Kind.UNPAIRED, "covered at the left edge"),
        # One mark, in two inks.
        (
            f'<path d="M0 22C6 22 9 30 4 34C2 36 1 38 0 38Z"/>'
            f'<path fill="{RED}" d="M60 38C54 38 51 30 56 26C58 24 59 22 60 22Z"/>',
            Kind.UNPAIRED,
            "covered at the",
        ),
        (
            f'<g fill="{RED}"><circle cy="25" r="9"/></g><circle cx="3" cy="35" r="9"/>'
            f'<circle cx="63" cy="35" r="9"/><circle fill="{RED}" cx="60" cy="25" r="9"/>',
            Kind.ORDER,
            "what lies on top differs: #1d2f5f at the left edge",
        ),
        (
            '<circle cy="30" r="9" opacity=".4"/><circle cx="60" cy="30" r="9"/>',
            Kind.TINT,
            "#1d2f5f at 40 % at the left edge",
        ),
        (
            '<defs><linearGradient id="a"><stop stop-color="#fff"/><stop offset="1" stop-color="#1d2f5f"/>'
            '</linearGradient></defs><path fill="url(#a)" d="M-5 10h70v20h-70z"/>',
            Kind.TINT,
            "a colour that runs jumps",
        ),
        (f'<path d="M0 0V60" stroke="{BLUE}" stroke-width="4"/>', Kind.UNPAIRED,
         "2 of the 4 mm of a line's breadth are cut off"),
        (f'<path d="M0 60L60 0" stroke="{BLUE}" stroke-width="4"/>', Kind.UNPAIRED, "leaves a nick"),
    ],
)  # fmt: skip
def test_what_the_page_cuts_without_a_twin_fails(body: str, kind: Kind, words: str) -> None:
    faults = found(body).faults
    assert kind in {fault.kind for fault in faults}
    assert any(words in fault.words for fault in faults), [fault.words for fault in faults]


@pytest.mark.parametrize(
    "body",
    [
        '<circle cy="30" r="9"/><circle cx="60" cy="30" r="9"/>',
        # What lies beneath may end where it likes.
        f'<path d="M0 20h9v20H0z"/><circle fill="{RED}" cy="30" r="20"/>'
        f'<circle fill="{RED}" cx="60" cy="30" r="20"/>',
        f'<path d="M0 0V60M60 0V60" stroke="{BLUE}" stroke-width="4"/>',
        # The corners of slanting lines, drawn on beyond the page as one does.
        f'<path d="M-5 65L65-5M-5 5L5-5M55 65L65 55" stroke="{BLUE}" stroke-width="4"/>',
        f'<path d="M0 60L60 0M0 0L60 60" stroke="{BLUE}" stroke-width="4"/>',
        # A gradient that runs down is the same on the left and on the right.
        '<defs><linearGradient id="a" x2="0" y2="1"><stop stop-color="#fff"/><stop offset="1"/>'
        '</linearGradient></defs><rect y="5" width="60" height="50" fill="url(#a)"/>',
        '<defs><radialGradient id="a" gradientUnits="userSpaceOnUse" cx="30" cy="30" r="50"><stop '
        'stop-color="#fff"/><stop offset="1" stop-color="#333"/></radialGradient></defs>'
        '<rect width="60" height="60"/><rect width="60" height="60" fill="url(#a)"/>',
        # Half a line in dashes, and its other half, in step.
        f'<path d="M0 0V60M60 0V60" stroke="{BLUE}" stroke-width="4" stroke-dasharray="8 4" '
        'stroke-dashoffset="4"/>',
    ],
)
def test_what_shows_no_seam_passes(body: str) -> None:
    certificate = found(body)
    assert certificate.faults == ()
    assert certificate.along == ()


def test_dashes_out_of_step_fail() -> None:
    line = f'<path d="M{{}} 0V60" stroke="{BLUE}" stroke-width="4" stroke-dasharray="8 4"{{}}/>'
    assert found(line.format(0, "") + line.format(60, ' stroke-dashoffset="3"')).faults


def test_dashes_fall_where_they_are_drawn() -> None:
    dashes = f'<path fill="none" stroke="{BLUE}" stroke-width="4" stroke-linecap="round" {{}}/>'
    # The first dash begins on the edge, and its cap does not come back at the other: the line is none.
    begun = found(dashes.format('d="M0 30H60" stroke-dasharray="6 6"'))
    assert begun.faults == ()
    assert edges(begun) == [("left", 28, 32)]
    whole = found(dashes.format('d="M0 30H60" stroke-dasharray="6 6" stroke-dashoffset="-3"'))
    assert whole.faults == ()
    assert edges(whole) == []
    # A row of dots, which are dashes of no length, with and without the twin of the one that the page cuts.
    assert found(dashes.format('d="M0 30H60" stroke-dasharray="0 12"')).faults
    twins = found(dashes.format('d="M-12 30H70" stroke-dasharray="0 12"'))
    assert twins.faults == ()
    assert edges(twins) == []


@pytest.mark.parametrize("apart", [0.02, 0.039])
def test_what_files_round_is_let_pass_and_told(apart: float) -> None:
    body = f'<path d="M0 20h60v{8 + apart}L0 28z"/>'
    certificate = found(body)
    assert certificate.faults == ()
    assert certificate.worst.mismatch == pytest.approx(apart, abs=0.002)
    (hint,) = certificate.hints
    assert f"--position {apart:.3f}".rstrip("0") in hint
    assert found(body, position=0.01).faults
    assert found(body, position=apart + 0.001).faults == ()


def test_borders_that_come_in_aslant_are_measured_across_themselves() -> None:
    # 0.12 mm along the edge are 0.03 mm across a border at 14 degrees.
    assert found('<path d="M0 10L60-5V55L0 40zM0 40l60 15v5H0zM0-.12L60 0v-15L0-15z"/>').faults
    steep = '<path d="M0 30L4 14V58H0zM60 30.1L56 46.1V58H60z"/>'
    assert found(steep).faults == ()
    assert found(steep, position=0.01).faults


@pytest.mark.parametrize("radius", [0.7, 1.5, 3, 3.7, 9, 29.99])
def test_a_disc_that_touches_the_edge_passes(radius: float) -> None:
    assert found(f'<circle cx="{radius}" cy="30" r="{radius}"/>').faults == ()


def test_a_repeat_or_a_page_that_would_fit_is_proposed() -> None:
    unit = '<path d="M0 20l8 10-8 10-8-10zM60 60l8 10-8 10-8-10zM60-20l8 10-8 10-8-10z"/>'
    certificate = found(unit, size="60 80")
    assert any("--repeat" in hint and '"half-drop"' in hint for hint in certificate.hints)
    assert found(unit, "half-drop", "60 80").faults == ()
    rounded = '<path d="M-8 30l8-9 8 9-8 9zM52.6 30l8-9 8 9-8 9z"/>'
    (hint,) = found(rounded).hints
    assert "60.6 mm" in hint
    assert "wide" in hint


def test_the_straight_repeat_is_proposed_before_a_drop_of_a_weave() -> None:
    # A weave of five alike courses repeats straight, and by drops of 1/5 to 4/5; by a half it does not.
    weave = "".join(f'<path d="M-5 {12 * k + 3}h20v6h-20zM55 {12 * k + 3}h20v6h-20z"/>' for k in range(5))
    assert found(weave, "drop 3/5").faults == ()
    certificate = found(weave, "half-drop")
    assert certificate.faults
    (hint,) = certificate.hints
    assert '--repeat "grid"' in hint


def test_blended_colours_are_not_measured() -> None:
    marks = '<circle style="mix-blend-mode:multiply" cx="30" cy="30" r="9"/>'
    certificate = found(marks)
    assert certificate.faults == ()
    assert "blended" in certificate.unmeasured[0]
