"""What things of a world have in common, and wrenches."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, NamedTuple

from ._lib import Array, ffi, host, refuse

if TYPE_CHECKING:
    from .world import World


class Wrench(NamedTuple):
    """A force [N] and its moment [N m] about a point."""

    force: Array
    moment: Array


class Held:
    """Holds plants while another thread would step them."""

    def __init__(self, world: Any) -> None:
        self.world = world

    def __enter__(self) -> None:
        host.frond_host_hold(self.world._handle)

    def __exit__(self, *_: Any) -> None:
        host.frond_host_let_go(self.world._handle)


class OfWorld:
    """Something of a world, known by its handle, which becomes stale when it goes."""

    _handle: Any
    world: World

    def __init__(self, handle: Any, world: World) -> None:
        if not isinstance(handle, ffi.CData):
            raise refuse("it is made by a method of World or Plant: add_plant, add_rigid, add_robot, grab, bond")
        self._handle = ffi.new(ffi.getctype(ffi.typeof(handle), "*"), handle)[0]
        self.world = world

    def _world_guard(self, function: Callable) -> Any:
        return self.world._world_guard(function)

    @property
    def id(self) -> int:
        """A number that is this thing's alone, 0 for none."""
        return int(self._handle.id)

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and other.id == self.id  # type: ignore[attr-defined]

    def __hash__(self) -> int:
        return hash(self.id)

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: Any) -> None:
        self.destroy()

    def destroy(self) -> None:
        raise NotImplementedError


__all__ = ["Held", "OfWorld", "Wrench"]
