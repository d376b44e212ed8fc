"""Plants."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ._generated import (Capsule, ChainState, Contact, Detail, Effect, Energy, Fragment, HeldTurns, Integrator, Mechanics,
                         PlantDef, SectionForce, Trouble, Vector)
from ._lib import (Array, address_of, array_out, changes_world, check, check_host, documented, ffi, fill, flag, host,
                   integer, lib, mask_of, need, numbers, real, refuse, row_of, to_python, vector, wrap_handle)
from .hold import Bond, Grab
from .thing import OfWorld, Wrench

if TYPE_CHECKING:
    from .model import Model
    from .rigid import Rigid


class Surface(NamedTuple):
    """The mesh of a plant or robot as it is now, copied."""

    positions: npt.NDArray[np.float32]
    """vertex_count x 3 [m]"""
    normals: npt.NDArray[np.float32] | None
    """vertex_count x 3, length one"""
    uvs: npt.NDArray[np.float32] | None
    """vertex_count x 2"""
    colors: npt.NDArray[np.uint8] | None
    """vertex_count x 4, RGBA"""
    triangles: npt.NDArray[np.int32]
    """triangle_count x 3"""


def copy_surface(view: Any) -> Surface:
    def copy(pointer: Any, dtype: str, count: int, width: int) -> Any:
        size = count * width * np.dtype(dtype).itemsize
        return np.frombuffer(bytes(ffi.buffer(pointer, size)), dtype).reshape(count, width) if pointer else None

    count = view.vertex_count
    triangles = copy(view.indices, "i4", view.triangle_count, 3)
    return Surface(copy(view.positions, "f4", count, 3), copy(view.normals, "f4", count, 3),
                   copy(view.uvs, "f4", count, 2), copy(view.colors, "u1", count, 4),
                   triangles if triangles is not None else np.zeros((0, 3), np.int32))


@documented
class Plant(OfWorld):
    """One plant of a world; World.add_plant makes it. Two objects of the same plant are equal."""

    @changes_world
    def destroy(self) -> None:
        """Removes the plant from its world. A second call does nothing."""
        lib.frond_plant_destroy(self._handle)
        self.world._models.pop(self.id, None)
        self.world._organs.pop(self.id, None)

    @property
    def is_valid(self) -> bool:
        """Whether it exists: it was not destroyed, nor its world."""
        return host.frond_host_is_alive(self.world._handle) and lib.frond_plant_is_valid(self._handle)

    @property
    def model(self) -> Model:
        """The model that it was made of."""
        try:
            return self.world._models[self.id]
        except KeyError:
            check(lib.frond_plant_wake(self._handle))
            raise refuse("the plant was not made by add_plant, so that its model is not known") from None

    @property
    def definition(self) -> PlantDef:
        """The settings with which it would be made as it is set now."""
        out = ffi.new("frond_plant_def *")
        check(lib.frond_plant_get_def(self._handle, out))
        return to_python(out[0], self.world)

    @property
    def user(self) -> int:
        """The number that its def carries; 0 for plants made here."""
        return int(ffi.cast("uintptr_t", lib.frond_plant_get_user(self._handle)))

    @property
    def bullet_object(self) -> int:
        """The address of its btCollisionObject, 0 for a stale plant."""
        return int(ffi.cast("uintptr_t", host.frond_host_get_object(self._handle)))

    # ---- setting

    @property
    def is_awake(self) -> bool:
        """Whether it is stepped."""
        return lib.frond_plant_is_awake(self._handle)

    def wake(self) -> None:
        """Wakes it for a reason that Frond cannot see."""
        check(lib.frond_plant_wake(self._handle))

    @changes_world
    def reset(self) -> None:
        """Puts it back to how it was made: whole, at rest."""
        check(lib.frond_plant_reset(self._handle))

    @changes_world
    def set_transform(self, position: Vector, rotation: Vector = (0, 0, 0, 1)) -> None:
        """Puts it elsewhere [m] and turns it, x y z w, with its shape and velocities."""
        turn = tuple(numbers(rotation, "rotation", (4,)).tolist())
        check(lib.frond_plant_set_transform(self._handle, vector(position, "position"), turn))

    def set_effects(self, effects: Effect | int) -> None:
        """Switches what acts on it."""
        check(lib.frond_plant_set_effects(self._handle, mask_of(effects, "effects")))

    def set_mechanics(self, mechanics: Mechanics | str) -> None:
        """Switches to other mechanics, from the same shape and velocities."""
        check(lib.frond_plant_set_mechanics(self._handle, row_of(mechanics, "frond_mechanics", "mechanics")))

    def set_integrator(self, integrator: Integrator | str) -> None:
        """Switches to another integrator."""
        check(lib.frond_plant_set_integrator(self._handle, row_of(integrator, "frond_integrator", "integrator")))

    def pin(self, node: int) -> None:
        """Holds a cage node where it is."""
        check(lib.frond_plant_pin(self._handle, integer(node, "node")))

    def unpin(self, node: int) -> None:
        """Lets a pinned node go."""
        check(lib.frond_plant_unpin(self._handle, integer(node, "node")))

    def move_pin(self, node: int, position: Vector) -> None:
        """Moves a pinned node [m] within the next step; of rods that one or two nodes hold, half a capsule a step."""
        check(lib.frond_plant_move_pin(self._handle, integer(node, "node"), vector(position, "position")))

    def add_force(self, node: int, force: Vector) -> None:
        """Adds a force [N] on a node, for the next call of step; of a world of PyBullet's, for its next substep."""
        check(lib.frond_plant_add_force(self._handle, integer(node, "node"), vector(force, "force")))

    def add_chain_load(self, chain_node: int, force: Vector = (0, 0, 0), moment: Vector = (0, 0, 0)) -> None:
        """Adds a force [N] and a moment [N m] on a chain node, for as long as add_force does."""
        check(lib.frond_plant_add_chain_load(self._handle, integer(chain_node, "chain_node"), vector(force, "force"),
                                             vector(moment, "moment")))

    def set_support(self, chain_node: int, held_turns: HeldTurns | str = "none", axis: Vector = (0, 0, 1),
                    holds_place: bool = True) -> None:
        """Holds a chain node of rods as it is now: by default as a ball joint does, "across_axis" as a hinge,
        "about_axis" as a fork, "all" as a clamp. Pins and the ground do not hold it meanwhile."""
        support = ffi.new("frond_support *")
        fill(support[0], {"holds_place": holds_place, "held_turns": held_turns, "axis": axis}, "a support")
        check(lib.frond_plant_set_support(self._handle, integer(chain_node, "chain_node"), support))

    def remove_support(self, chain_node: int) -> None:
        """Leaves a chain node to pins and the ground again, where it is now."""
        check(lib.frond_plant_set_support(self._handle, integer(chain_node, "chain_node"), ffi.NULL))

    def support_force(self, chain_node: int) -> Wrench:
        """Returns the force of a support on its chain node [N], and the moment about the node [N m]."""
        force, moment = ffi.new("frond_vec3 *"), ffi.new("frond_vec3 *")
        check(lib.frond_plant_get_support_force(self._handle, integer(chain_node, "chain_node"), force, moment))
        return Wrench(to_python(force[0]), to_python(moment[0]))

    def add_distributed_load(self, capsule: int, force_per_length: Vector) -> None:
        """Adds a force per length [N/m] on a capsule, for as long as add_force does."""
        check(lib.frond_plant_add_distributed_load(self._handle, integer(capsule, "capsule"),
                                                   vector(force_per_length, "force_per_length")))

    @changes_world
    def break_at(self, capsule: int) -> None:
        """Breaks it at a capsule, whatever its strength."""
        check(lib.frond_plant_break(self._handle, integer(capsule, "capsule")))

    # ---- state

    @property
    def node_count(self) -> int:
        """The number of cage nodes; 0 for a stale plant."""
        return lib.frond_plant_get_node_count(self._handle)

    @property
    def capsule_count(self) -> int:
        """The number of capsules; 0 for a stale plant."""
        return lib.frond_plant_get_capsule_count(self._handle)

    def get_state(self) -> tuple[Array, Array]:
        """Returns positions [m] and velocities [m/s] of the cage's nodes, node_count x 3 each."""
        count = self.node_count
        (x, x_out), (v, v_out) = array_out(count), array_out(count)
        check(lib.frond_plant_get_state(self._handle, x_out, v_out, count))
        return x, v

    def set_state(self, positions: npt.ArrayLike | None = None, velocities: npt.ArrayLike | None = None) -> None:
        """Sets positions [m] and velocities [m/s] of the cage's nodes, node_count x 3; None leaves them."""
        arrays = [None if a is None else numbers(a, name, (-1, 3))
                  for a, name in ((positions, "positions"), (velocities, "velocities"))]
        counts = {len(array) for array in arrays if array is not None}
        if len(counts) > 1:
            raise refuse("positions and velocities are of different length")
        pointers = [ffi.NULL if array is None else ffi.from_buffer("double[]", array) for array in arrays]
        check(lib.frond_plant_set_state(self._handle, *pointers, counts.pop() if counts else self.node_count))

    @property
    def chain_node_count(self) -> int:
        """The number of chain nodes; 0 for a stale plant."""
        return lib.frond_plant_get_chain_node_count(self._handle)

    @property
    def chain_state(self) -> list[ChainState]:
        """The motion of all chain nodes, of rods."""
        count = self.chain_node_count
        out = ffi.new("frond_chain_state[]", max(count, 1))
        check(lib.frond_plant_get_chain_state(self._handle, out, count))
        return [to_python(out[i]) for i in range(count)]

    def set_chain_state(self, states: Sequence[ChainState]) -> None:
        """Sets the motion of all chain nodes, as chain_state gives it."""
        if not isinstance(states, (list, tuple)):
            raise refuse(f"states is {states!r}; pass a list of ChainState")
        array = ffi.new("frond_chain_state[]", max(len(states), 1))
        for i, state in enumerate(states):
            fill(array[i], vars(need(state, ChainState, f"state {i}")), "a chain state")
        check(lib.frond_plant_set_chain_state(self._handle, array, len(states)))

    def get_plastic(self) -> Array:
        """Returns the plastic state, empty as long as nothing has yielded."""
        array, out = array_out(lib.frond_plant_get_plastic_count(self._handle), 0)
        check(lib.frond_plant_get_plastic(self._handle, out, len(array)))
        return array

    def set_plastic(self, values: npt.ArrayLike) -> None:
        """Sets what get_plastic gave; an empty array makes the plant elastic again."""
        array = numbers(values, "values", (-1,))
        out = ffi.from_buffer("double[]", array) if array.size else ffi.NULL
        check(lib.frond_plant_set_plastic(self._handle, out, array.size))

    @property
    def surface(self) -> Surface:
        """The mesh as it is now, copied."""
        out = ffi.new("frond_surface_view *")
        check(lib.frond_plant_get_surface(self._handle, out))
        return copy_surface(out)

    @property
    def previous_positions(self) -> npt.NDArray[np.float32]:
        """The positions of the surface in the previous frame [m], vertex_count x 3, copied."""
        view, out = ffi.new("frond_surface_view *"), ffi.new("const float **")
        check(lib.frond_plant_get_surface(self._handle, view))
        check(lib.frond_plant_get_previous_positions(self._handle, out))
        data = bytes(ffi.buffer(out[0], 12 * view.vertex_count))
        return np.frombuffer(data, np.float32).reshape(-1, 3)

    @property
    def capsules(self) -> list[Capsule]:
        """The capsules as they are now."""
        count = self.capsule_count
        out = ffi.new("frond_capsule[]", max(count, 1))
        check(lib.frond_plant_get_capsules(self._handle, out, count))
        return [to_python(out[i]) for i in range(count)]

    @property
    def tip(self) -> Array:
        """The highest point against gravity [m]."""
        return self._vector(lib.frond_plant_get_tip)

    @property
    def detail(self) -> Detail:
        """How much of it is simulated now."""
        out = ffi.new("frond_detail *")
        check(lib.frond_plant_get_detail(self._handle, out))
        return Detail(int(ffi.cast("int", out[0])) if isinstance(out[0], ffi.CData) else out[0])

    @property
    def trouble(self) -> Trouble:
        """What went wrong with it in the last substep, and what moved it without a force."""
        out = ffi.new("uint32_t *")
        check(lib.frond_plant_get_trouble(self._handle, out))
        return Trouble(out[0])

    def _vector(self, get: Any) -> Array:
        out = ffi.new("frond_vec3 *")
        check(get(self._handle, out))
        return to_python(out[0])

    # ---- forces and energies

    @property
    def contacts(self) -> list[Contact]:
        """The points at which bodies and plants touched it in the last substep; World.forces has means too."""
        count = lib.frond_plant_get_contact_count(self._handle)
        out = ffi.new("frond_contact[]", max(count, 1))
        check(lib.frond_plant_get_contacts(self._handle, out, count))
        return [to_python(out[i], self.world) for i in range(count)]

    def root_force(self, about: Vector = (0, 0, 0), mean: bool = False) -> Wrench:
        """Returns the force of the ground on it [N], and its moment about a point [N m], now; or the mean over the last
        call of step or stepSimulation, recorded from the first such request on."""
        force, moment = ffi.new("frond_vec3 *"), ffi.new("frond_vec3 *")
        point = vector(about, "about")
        if not flag(mean, "mean"):
            check(lib.frond_plant_get_root_force(self._handle, point, force, moment))
            return Wrench(to_python(force[0]), to_python(moment[0]))
        check_host(host.frond_host_record(self.world._handle))
        check_host(host.frond_host_get_root_force(self._handle, force, moment))
        total = to_python(force[0])
        return Wrench(total, to_python(moment[0]) - np.cross(point, total))

    @property
    def energy(self) -> Energy:
        """Kinetic, elastic and gravitational energy [J]."""
        out = ffi.new("frond_energy *")
        check(lib.frond_plant_get_energy(self._handle, out))
        return to_python(out[0])

    @property
    def strains(self) -> Array:
        """The strain of the outermost fibre of each capsule's organ [-], capsule_count."""
        array, out = array_out(self.capsule_count, 0)
        check(lib.frond_plant_get_strains(self._handle, out, len(array)))
        return array

    @property
    def section_forces(self) -> list[SectionForce]:
        """Force and moment in the middle of each capsule, of rods."""
        count = self.capsule_count
        out = ffi.new("frond_section_force[]", max(count, 1))
        check(lib.frond_plant_get_section_forces(self._handle, out, count))
        return [to_python(out[i]) for i in range(count)]

    @property
    def air_force(self) -> Array:
        """The force of the air on it [N]."""
        return self._vector(lib.frond_plant_get_air_force)

    @property
    def momentum(self) -> Array:
        """The momentum of all its nodes [kg m/s]."""
        return self._vector(lib.frond_plant_get_momentum)

    @property
    def fragments(self) -> list[Fragment]:
        """What broke off, in order."""
        found = []
        for i in range(lib.frond_plant_get_fragment_count(self._handle)):
            out = ffi.new("frond_fragment *")
            check(lib.frond_plant_get_fragment(self._handle, i, out))
            found.append(to_python(out[0], self.world))
        return found

    # ---- holding

    @changes_world
    def grab(self, point: Vector, stiffness: float) -> Grab:
        """Takes hold of the surface nearest to a point [m] by a spring [N/m]."""
        out = ffi.new("frond_grab *")
        check(lib.frond_grab_create(self._handle, vector(point, "point"), real(stiffness, "stiffness"), out))
        return Grab(out[0], self.world)

    @changes_world
    def bond(self, point: Vector, rigid: Rigid) -> Bond:
        """Holds the surface nearest to a point [m] to a rigid body, where it is now."""
        if not isinstance(rigid, wrap_handle["frond_rigid"]):
            raise refuse(f"rigid is {rigid!r}; pass a Rigid, or use bond_robot or bond_body")
        out = ffi.new("frond_bond *")
        check(lib.frond_bond_create(self._handle, vector(point, "point"), rigid._handle, out))
        return Bond(out[0], self.world)

    @changes_world
    def bond_robot(self, point: Vector, robot: Any, link: int) -> Bond:
        """Holds the surface nearest to a point [m] to a link of a Robot, as a gripper does."""
        if not isinstance(robot, wrap_handle["frond_robot"]):
            raise refuse(f"robot is {robot!r}; pass a Robot")
        out = ffi.new("frond_bond *")
        check(lib.frond_robot_bond(self._handle, vector(point, "point"), robot._handle, integer(link, "link"), out))
        return Bond(out[0], self.world)

    @changes_world
    def bond_body(self, point: Vector, body: int, link: int = -1) -> Bond:
        """Holds the surface nearest to a point [m] to a body of PyBullet's, by its unique id and link."""
        object_ = host.frond_host_find_body(self.world._handle, integer(body, "body"), integer(link, "link"))
        if not object_:
            check(lib.frond_plant_wake(self._handle))
            raise refuse(f"PyBullet's world has no body {body} with a link {link} that collides")
        out = ffi.new("frond_bond *")
        check_host(host.frond_host_bond(self._handle, vector(point, "point"), object_, out))
        return Bond(out[0], self.world)


def plant_at(world: Any, object_: int) -> Plant | None:
    """Returns the plant whose collision object is at this address, None if it is not one's."""
    from .world import World

    handle = host.frond_host_get_plant(need(world, World, "world")._handle,
                                       ffi.cast("void *", address_of(object_, "object_")))
    return Plant(handle, world) if handle.id else None


wrap_handle["frond_plant"] = Plant

__all__ = ["Plant", "Surface", "plant_at"]
