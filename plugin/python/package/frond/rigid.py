"""Rigid bodies that Frond makes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._generated import RigidState
from ._lib import changes_world, check, documented, ffi, fill, host, lib, to_python, wrap_handle
from .thing import OfWorld

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._generated import RigidStateOptions


@documented
class Rigid(OfWorld):
    """A rigid body; World.add_rigid makes it."""

    @changes_world
    def destroy(self) -> None:
        """Removes it. A plant's fragment goes with its plant."""
        lib.frond_rigid_destroy(self._handle)

    @property
    def is_valid(self) -> bool:
        """Whether it exists."""
        return host.frond_host_is_alive(self.world._handle) and lib.frond_rigid_is_valid(self._handle)

    @property
    def state(self) -> RigidState:
        """Position [m], rotation x y z w, velocities [m/s], [rad/s]."""
        out = ffi.new("frond_rigid_state *")
        check(lib.frond_rigid_get_state(self._handle, out))
        return to_python(out[0])

    @changes_world
    def set_state(self, **state: Unpack[RigidStateOptions]) -> None:
        """Puts it elsewhere; what is not given stays as it is."""
        out = ffi.new("frond_rigid_state *")
        check(lib.frond_rigid_get_state(self._handle, out))
        fill(out[0], state, "a state")
        check(lib.frond_rigid_set_state(self._handle, out))

    @property
    def body(self) -> int:
        """The address of its collision object, as Contact.body and the column object of World.forces have it."""
        return int(ffi.cast("uintptr_t", lib.frond_rigid_get_body(self._handle)))


wrap_handle["frond_rigid"] = Rigid

__all__ = ["Rigid"]
