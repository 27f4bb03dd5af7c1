"""Drawings as other programs write them."""

from __future__ import annotations

DISC = '<circle cx="50" cy="50" r="20"/>'


def svg(inner: str, head: str = 'width="100mm" height="100mm" viewBox="0 0 100 100"') -> bytes:
    spaces = (
        'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
    )
    return f"<svg {spaces} {head}>\n{inner}\n</svg>".encode()


MIXED = """
<style>.leaf, #one { fill: rgb(140, 47, 43) } path.thin { fill: none; stroke: navy; stroke-width: 2px }
  g &gt; .deep { fill: teal !important } </style>
<defs>
  <path id="leaf" class="leaf" d="M0 0C10-10 20-10 30 0C20 10 10 10 0 0z"/>
  <symbol id="star" viewBox="-1 -1 2 2" fill="#a86f3a"><path
    d="M0-1L.3.3 1 0 .3.3 0 1-.3.3-1 0-.3.3z"/></symbol>
  <linearGradient id="g"><stop offset="0" style="stop-color:#abc"/></linearGradient>
</defs>
<rect width="100%" height="100%" fill="#f4efe2"/>
<g transform="translate(50 50)" style="stroke-linejoin:round;stroke-linecap:round">
  <use xlink:href="#leaf" transform="rotate(45)"/><use href="#leaf" x="-40" y="5"/>
  <use href="#star" x="-20" y="-40" width="20" height="20"/>
  <path class="thin" d="M-40-40q10 10 20 0t20 0"/>
  <g><rect class="deep" style="fill:red" x="10" y="20" width="15" height="9" rx="3"/></g>
  <g color="#161b30"><circle cx="-25" cy="30" r="8" fill="currentColor" stroke="olive" stroke-width="3"/></g>
  <g visibility="hidden"><circle r="30"/><circle visibility="visible" cx="30" cy="-25" r="6" id="one"/></g>
  <g display="none"><circle r="30"/></g>
  <text style="display:none">not drawn</text>
</g>
<svg x="70" y="0" width="30" height="30" viewBox="0 0 10 10"><path d="M1 1h8v8z" fill="green"/></svg>
<switch><foreignObject requiredExtensions="x"/><g><path d="M5 95h10v-10z" fill="#333"/></g></switch>
"""
