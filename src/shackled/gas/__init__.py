"""What a picture costs: exactly, by a search over gas limits, by stage and by line, and where it fits."""

import sys
from types import ModuleType

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


class _Package(ModuleType):
    """A package that is easily taken for a function: a call of it raises an error that names its functions."""

    def __call__(self, *_: object, **__: object) -> None:
        raise TypeError(f"{self.__name__} is a package: call one of its functions, {', '.join(self.__all__)}")


sys.modules[__name__].__class__ = _Package
