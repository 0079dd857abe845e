# SPDX-License-Identifier: Apache-2.0
"""An answer as HTML: the blocks that plumb shows, in their order."""
from __future__ import annotations

import base64
from html import escape
from typing import Any, Callable, Optional

from .errors import PlumbError

Figure = Optional[Callable[[str], str]]


def page(answer: dict[str, Any], figure: Figure) -> str:
    result = answer["result"]
    blocks = result.get("blocks")
    body = [_block(one, figure) for one in blocks] if blocks else [_members(result)]
    messages = [f"<p><b>{escape(one['severity'])}</b> {escape(one['message'])}</p>" for one in answer["warnings"]]
    return "<div>" + "".join(messages + body) + "</div>"


def _block(block: dict[str, Any], figure: Figure) -> str:
    kind = block["kind"]
    if kind == "sentence":
        return f"<p>{escape(block['words'])}</p>"
    if kind == "note":
        return f"<p><small>{escape(block['words'])}</small></p>"
    if kind == "table" and block["rows"]:
        return _table(block["head"], block["rows"], block["caption"])
    if kind == "figure" and figure is not None:
        return _image(block["name"], figure)
    if kind == "action":
        return f"<p><code>{escape(block['command'])}</code> {escape(block['why'])}</p>"
    return ""


def _image(name: str, figure: Callable[[str], str]) -> str:
    """As an image, so that the styles of a figure stay inside it."""
    try:
        svg = figure(name)
    except PlumbError as error:
        return f"<p>{escape(name)}: {escape(error.message)}</p>"
    return f'<img alt="{escape(name)}" src="data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}">'


def _table(head: list[str], rows: list[list[str]], caption: str = "") -> str:
    def row(cells: list[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"
    return f"<table><caption>{escape(caption)}</caption>{row(head, 'th')}{''.join(row(one, 'td') for one in rows)}</table>"


def _members(result: dict[str, Any]) -> str:
    """Where a verb has no blocks: what is no list and no object."""
    rows = [[name, str(value)] for name, value in result.items() if not isinstance(value, (list, dict))]
    return _table(["member", "value"], rows)
