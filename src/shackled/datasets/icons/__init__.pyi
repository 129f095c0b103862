from ._collection import ICONS, find, pieces
from ._icon import Icon

__all__ = ["ICONS", "Icon", "find", "pieces"]
