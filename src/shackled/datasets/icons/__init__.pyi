from ._collection import ICONS, find, pieces
from ._icon import IconModel

__all__ = ["ICONS", "IconModel", "find", "pieces"]
