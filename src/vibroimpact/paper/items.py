"""All that the report consists of, in the paper's order."""

from __future__ import annotations

from vibroimpact.paper import (
    fig03,
    fig04,
    fig05,
    fig06,
    fig07,
    fig08,
    fig09,
    fig10,
    fig11,
    fig12,
    fig13,
    fig14,
    fig15,
    fig16,
    fig17,
    fig18,
    fig19,
    fig20,
    fig21,
    table1,
)
from vibroimpact.paper.item import Item

ITEMS: tuple[Item, ...] = (
    fig03.ITEM,
    fig04.ITEM,
    fig05.ITEM,
    fig06.ITEM,
    fig07.ITEM,
    fig08.ITEM,
    fig09.ITEM,
    fig10.ITEM,
    fig11.ITEM,
    fig12.ITEM,
    fig13.ITEM,
    fig14.ITEM,
    fig15.ITEM,
    fig16.ITEM,
    fig17.ITEM,
    fig18.ITEM,
    fig19.ITEM,
    fig20.ITEM,
    table1.ITEM,
    fig21.ITEM,
)
