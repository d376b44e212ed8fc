"""What holds plants: grabs and bonds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._lib import Array, changes_world, check, check_host, documented, ffi, flag, host, lib, to_python, vector
from .thing import OfWorld

if TYPE_CHECKING:
    from ._generated import Vector


@documented
class Grab(OfWorld):
    """A spring between a point of a plant and a target; Plant.grab makes it."""

    def move(self, target: Vector) -> None:
        """Moves the target [m]."""
        check(lib.frond_grab_move(self._handle, vector(target, "target")))

    def _get(self, which: int) -> Array:
        out = [ffi.new("frond_vec3 *") for _ in range(3)]
        check(lib.frond_grab_get(self._handle, *out))
        return to_python(out[which][0])

    @property
    def point(self) -> Array:
        """The point of the plant that is held [m]."""
        return self._get(0)

    @property
    def target(self) -> Array:
        """Where the spring pulls to [m]."""
        return self._get(1)

    @property
    def force(self) -> Array:
        """The force on the plant [N]."""
        return self._get(2)

    @changes_world
    def destroy(self) -> None:
        """Lets go."""
        lib.frond_grab_destroy(self._handle)

    @property
    def is_valid(self) -> bool:
        """Whether it still holds."""
        return host.frond_host_is_alive(self.world._handle) and lib.frond_grab_is_valid(self._handle)


@documented
class Bond(OfWorld):
    """A point of a plant held to a body; Plant.bond makes it."""

    @property
    def point(self) -> Array:
        """The point of the plant that is held [m]."""
        out = ffi.new("frond_vec3 *")
        check(lib.frond_bond_get(self._handle, out, ffi.NULL))
        return to_python(out[0])

    def force(self, mean: bool = False) -> Array:
        """Returns the force on the plant [N] in the last substep; or the mean over the last call of step or
        stepSimulation, recorded from the first such request on."""
        out = ffi.new("frond_vec3 *")
        if flag(mean, "mean"):
            check_host(host.frond_host_get_bond_force(self.world._handle, self._handle, out))
        else:
            check(lib.frond_bond_get(self._handle, ffi.NULL, out))
        return to_python(out[0])

    @changes_world
    def destroy(self) -> None:
        """Lets go."""
        lib.frond_bond_destroy(self._handle)

    @property
    def is_valid(self) -> bool:
        """Whether it exists."""
        return host.frond_host_is_alive(self.world._handle) and lib.frond_bond_is_valid(self._handle)


__all__ = ["Bond", "Grab"]
