"""Methods of a class that are defined in rooms above it.

A trajectory is saved by `pendula.io` and drawn by `pendula.plot`, which stand above it. The face of
the package says where such methods come from (`promise`), the class takes them (`with_promised`),
and the room that defines one attaches it (`method_of`). The first use of a method whose room is not
imported yet imports it.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeVar

    Class = TypeVar("Class", bound=type)
    Function = TypeVar("Function", bound=Callable[..., Any])

_promised: dict[str, dict[str, str]] = {}


def promise(owner: str, module: str, *names: str) -> None:
    """Say that a module attaches these methods to the class of that name."""
    _promised.setdefault(owner, {}).update(dict.fromkeys(names, module))


def with_promised(owner: Class) -> Class:
    """Give a class the methods promised to it; each stands in until its module is imported."""
    for name, module in _promised.get(owner.__name__, {}).items():
        setattr(owner, name, _Promised(owner, name, module))
    return owner


def method_of(owner: type) -> Callable[[Function], Function]:
    """Attach the decorated function to the class as a method; it stays a function too."""

    def attach(function: Function) -> Function:
        setattr(owner, function.__name__, function)
        return function

    return attach


class _Promised:
    """Stands in for a method until the module that attaches it is imported."""

    def __init__(self, owner: type, name: str, module: str) -> None:
        self._owner, self._name, self._module = owner, name, module

    def __get__(self, instance: object, owner: type) -> Any:
        import_module(self._module)
        if vars(self._owner)[self._name] is self:
            raise AttributeError(f"{self._module} attached no {self._name} to {self._owner!r}")
        return getattr(owner if instance is None else instance, self._name)
