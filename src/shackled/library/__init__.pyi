from ._items import Item, chosen_items, items

__all__ = ["Item", "chosen_items", "items"]
