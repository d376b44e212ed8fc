"""Robots of Frond's own: arms and grippers from URDF files. Robots of PyBullet's stay PyBullet's."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._generated import LinkState, RobotLink
from ._lib import changes_world, check, documented, ffi, host, integer, lib, real, to_python, wrap_handle
from .thing import OfWorld

if TYPE_CHECKING:
    from .plant import Surface


@documented
class Robot(OfWorld):
    """A tree of links with motors; World.add_robot loads it. Links are numbered from the base, 0."""

    @changes_world
    def destroy(self) -> None:
        """Removes it."""
        lib.frond_robot_destroy(self._handle)

    @property
    def is_valid(self) -> bool:
        """Whether it exists."""
        return host.frond_host_is_alive(self.world._handle) and lib.frond_robot_is_valid(self._handle)

    @property
    def link_count(self) -> int:
        """The number of links; 0 for a stale robot."""
        return lib.frond_robot_get_link_count(self._handle)

    def find_link(self, name: str) -> int:
        """Returns the number of the link of this name, or whose joint has it; -1: none."""
        return lib.frond_robot_find_link(self._handle, str(name).encode())

    def link(self, link: int) -> RobotLink:
        """Describes what does not change of a link."""
        out = ffi.new("frond_robot_link *")
        check(lib.frond_robot_get_link(self._handle, integer(link, "link"), out))
        return to_python(out[0])

    def link_state(self, link: int) -> LinkState:
        """Returns where a link is, and the force of all plants on it."""
        out = ffi.new("frond_link_state *")
        check(lib.frond_robot_get_link_state(self._handle, integer(link, "link"), out))
        return to_python(out[0])

    @property
    def surface(self) -> Surface:
        """The collision shapes of all links as triangles, copied."""
        from .plant import copy_surface

        out = ffi.new("frond_surface_view *")
        check(lib.frond_robot_get_surface(self._handle, out))
        return copy_surface(out)

    @changes_world
    def set_joint(self, link: int, position: float) -> None:
        """Puts a joint there at once [rad], [m]."""
        check(lib.frond_robot_set_joint(self._handle, integer(link, "link"), real(position, "position")))

    def drive_to(self, link: int, position: float, max_velocity: float = 0, max_force: float = 0) -> None:
        """Drives a joint to a position [rad], [m]; 0: the file's limits of velocity and force."""
        check(lib.frond_robot_drive_to(self._handle, integer(link, "link"), real(position, "position"),
                                       real(max_velocity, "max_velocity"), real(max_force, "max_force")))

    def drive_at(self, link: int, velocity: float, max_force: float = 0) -> None:
        """Drives a joint at a velocity [rad/s], [m/s]; 0: the file's limit of force."""
        check(lib.frond_robot_drive_at(self._handle, integer(link, "link"), real(velocity, "velocity"),
                                       real(max_force, "max_force")))

    def release(self, link: int) -> None:
        """Lets a joint move freely."""
        check(lib.frond_robot_release(self._handle, integer(link, "link")))

    @property
    def multi_body(self) -> int:
        """The address of its btMultiBody, 0 for a stale robot."""
        return int(ffi.cast("uintptr_t", host.frond_host_get_multi_body(self._handle)))

    def joint_motor(self, link: int) -> int:
        """Returns the address of a joint's btMultiBodyJointMotor, 0 for a joint that is fixed."""
        return int(ffi.cast("uintptr_t", host.frond_host_get_motor(self._handle, integer(link, "link"))))


wrap_handle["frond_robot"] = Robot

__all__ = ["Robot"]
