"""Random SVG documents: shapes, transforms, styles, clips and patterns, each in a handful of colours."""

from __future__ import annotations

from hypothesis import strategies as st

COLOURS = ("#c00000", "#00a000", "#0000c0")
whole = st.integers(-20, 120)
lengths = st.integers(4, 60)


@st.composite
def transforms(draw: st.DrawFn, even: bool = False) -> str:
    """A transform, or an even one that leaves lines as broad in every direction."""
    kinds = ["", "", "translate", "rotate", "scale"]
    kind = draw(st.sampled_from(kinds if even else [*kinds, "skewX", "matrix"]))
    small = st.floats(-0.6, 0.6).map(lambda x: round(x, 2))
    values = {
        "": "",
        "translate": f"{draw(st.integers(-30, 30))} {draw(st.integers(-30, 30))}",
        "rotate": f"{draw(st.integers(-180, 180))} 50 50",
        "scale": f"{draw(st.sampled_from([0.5, 0.8, 1.3, -1]))}",
        "skewX": f"{draw(st.integers(-30, 30))}",
        "matrix": f"{1 + draw(small)} {draw(small)} {draw(small)} {1 + draw(small)} {draw(whole)} 9",
    }
    return f' transform="{kind}({values[kind]})"' if kind else ""


@st.composite
def outlines(draw: st.DrawFn) -> str:
    """An element without its paint, open at the end."""
    kind = draw(st.sampled_from(["rect", "circle", "ellipse", "polygon", "path", "curve", "arc"]))
    x, y, a, b = draw(whole), draw(whole), draw(lengths), draw(lengths)
    if kind == "rect":
        return f'<rect x="{x}" y="{y}" width="{a}" height="{b}" rx="{draw(st.integers(0, 9))}"'
    if kind == "circle":
        return f'<circle cx="{x}" cy="{y}" r="{a / 2}"'
    if kind == "ellipse":
        return f'<ellipse cx="{x}" cy="{y}" rx="{a / 2}" ry="{b / 2}"'
    places = draw(st.lists(st.tuples(whole, whole), min_size=3, max_size=6))
    if kind == "polygon":
        return f'<polygon points="{" ".join(f"{u},{v}" for u, v in places)}"'
    if kind == "path":
        steps = "".join(f"l{u - 50} {v - 50}" for u, v in places)
        return f'<path d="M50 50{steps}zm9 4h{a}v{b}h-{a}z"'
    if kind == "curve":
        (u, v), (p, q), (r, s), *_ = places
        return f'<path d="M{x} {y}C{u} {v} {p} {q} {r} {s}S{a} {b} {x + 20} {y}Q{v} {u} {q} {p}T{s} {r}z"'
    return f'<path d="M{x} {y}a{a} {b} {draw(whole)} {draw(st.integers(0, 1))}1 {a} {b / 2}z"'


@st.composite
def paints(draw: st.DrawFn, patterned: bool) -> str:
    """Attributes or a style; lines are mitred, butted, and broad enough to be seen."""
    colour, line = draw(st.sampled_from(COLOURS)), draw(st.sampled_from(COLOURS))
    fill = draw(st.sampled_from([colour, colour, "none", "url(#p)" if patterned else colour]))
    stroke = draw(st.sampled_from(["none", "none", line]))
    if fill == stroke == "none":
        fill = colour
    pairs = {
        "fill": fill,
        "stroke": stroke,
        "stroke-width": str(draw(st.integers(1, 6))),
        "fill-rule": draw(st.sampled_from(["nonzero", "evenodd"])),
        "stroke-linejoin": "miter",
    }
    if draw(st.booleans()):
        return ' style="' + ";".join(f"{key}:{value}" for key, value in pairs.items()) + '"'
    return "".join(f' {key}="{value}"' for key, value in pairs.items())


@st.composite
def clip_paths(draw: st.DrawFn, name: str, inner: str) -> str:
    # resvg 0.5.0 measures a clip of a clip by the first mark's box, so one in shares clips marks alone.
    boxed = bool(inner) and draw(st.integers(0, 2)) == 0
    units = ' clipPathUnits="objectBoundingBox"' if boxed else ""
    if boxed:
        shape = draw(st.sampled_from(['<circle cx=".5" cy=".5" r=".4"/>', '<path d="M0 0h.7v.9z"/>']))
    else:
        rule = draw(st.sampled_from(["nonzero", "evenodd"]))
        shapes = draw(st.lists(outlines(), min_size=1, max_size=2))
        shape = "".join(f'{each} clip-rule="{rule}"{draw(transforms())}/>' for each in shapes)
        if draw(st.integers(0, 3)) == 0:
            shape += f'<use href="#mark"{draw(transforms())}/>'
    within = f' clip-path="url(#{inner})"' if inner and draw(st.booleans()) else ""
    return f'<clipPath id="{name}"{units}{within}{"" if boxed else draw(transforms())}>{shape}</clipPath>'


@st.composite
def pattern_servers(draw: st.DrawFn) -> str:
    """A pattern whose cell is a whole number of pixels, since some renderers round it."""
    width, height = draw(st.integers(8, 30)), draw(st.integers(8, 30))
    content = f'<rect width="{width // 2}" height="{height // 2}" fill="{COLOURS[0]}"/>'
    if draw(st.booleans()):
        content += (
            f'<circle cx="{width}" cy="{height // 2}" r="{min(width, height) // 3}" fill="{COLOURS[1]}"/>'
        )
    framed = draw(st.booleans())
    frame = f' viewBox="0 0 {width} {height}"' if framed else ""
    size = (width * 2, height * 2) if framed else (width, height)
    turn = f' patternTransform="translate({draw(st.integers(0, 9))} 3)"' if draw(st.booleans()) else ""
    return (
        f'<pattern id="q" patternUnits="userSpaceOnUse" width="{size[0]}" height="{size[1]}"{frame}>'
        # resvg 0.5.0 takes no patternTransform over from the pattern that is referred to, as browsers do.
        f'{content}</pattern><pattern id="p" href="#q" x="{draw(st.integers(0, 5))}"{turn}/>'
    )


@st.composite
def drawings(draw: st.DrawFn) -> str:
    """What stands in an svg of 100 × 100 units."""
    patterned = draw(st.integers(0, 3)) == 0
    definitions = '<path id="mark" d="M20 20h50v30l-30 20z"/>' + draw(clip_paths("c", "d"))
    definitions += draw(clip_paths("d", "")) + (draw(pattern_servers()) if patterned else "")
    marks = []
    for _ in range(draw(st.integers(1, 4))):
        clip = draw(st.sampled_from(["", "", ' clip-path="url(#c)"', ' clip-path="url(#d)"']))
        paint = draw(paints(patterned))
        even = "stroke:#" in paint or 'stroke="#' in paint
        mark = f"{draw(outlines())}{paint}{draw(transforms(even))}{clip}/>"
        kind = draw(st.integers(0, 5))
        if kind == 0:
            # The box of a group round turned marks is the tight one (SVG 2, 8.10); resvg takes the box of
            # turned boxes, so a clip in shares of it is left to marks.
            boxed = "objectBoundingBox" in definitions
            clip = "" if boxed else draw(st.sampled_from(["", ' clip-path="url(#c)"']))
            mark = f"<g{draw(transforms(even))}{clip}>{mark}</g>"
        elif kind == 1:
            frame = f'x="{draw(whole)}" y="5" width="{draw(lengths)}" height="{draw(lengths)}"'
            box = draw(st.sampled_from(["", ' viewBox="0 0 100 100"', ' viewBox="10 0 50 80"']))
            mark = f"<svg {frame}{box}>{mark}</svg>"
        elif kind == 2:
            mark = f'<use href="#mark" x="{draw(whole)}"{paint}{draw(transforms(even))}{clip}/>'
        marks.append(mark)
    return f"<defs>{definitions}</defs>" + "".join(marks)
