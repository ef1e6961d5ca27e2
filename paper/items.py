"""All items of the report in the order of the paper, followed by those of the refined isolator."""

from __future__ import annotations

from paper import (
    campaign,
    curves,
    families,
    fig03,
    fig04,
    fig14,
    fig15,
    fig21,
    motions,
    refined,
    table1,
)
from paper.report_item import Item

_SINGLE = (fig03, fig04, fig14, fig15, fig21, table1)
_ALL = (
    *campaign.ITEMS,
    *curves.ITEMS,
    *motions.ITEMS,
    *families.ITEMS,
    *(one.ITEM for one in _SINGLE),
)
_LAST = {"table1": "fig20"}  # it stands in Section 7, before Fig. 21

ITEMS: tuple[Item, ...] = (
    *sorted(_ALL, key=lambda item: (_LAST.get(item.key, item.key), item.key)),
    *refined.ITEMS,
)
