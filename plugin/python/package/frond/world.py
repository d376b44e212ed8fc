"""Worlds: plants of one Bullet world, of Frond's own or of PyBullet's."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from ._generated import Effect, EnergyLedger, EventInfo, Profile, RayHit, Report, Vector
from ._lib import (Array, Error, changes_world, check, check_host, documented, ffi, fill, flag, host,
                   integer, lib, make_def, mask_of, need, numbers, real, refuse, to_python, vector, wrap_handle)
from .thing import Wrench

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._generated import (DetailDefOptions, PlantDefOptions, RigidDefOptions, RobotDefOptions, WindDefOptions,
                             WorldDefOptions)
    from ._generated import RigidStateOptions
    from .model import Model
    from .plant import Plant
    from .rigid import Rigid
    from .robot import Robot

    class RigidOptions(RigidDefOptions, RigidStateOptions, total=False):
        """What RigidDef and its state have."""


AS_MOTION_STATES = -1.0
"""For World.set_interpolation: as Bullet's motion states have the bodies."""

FORCE_TYPE = np.dtype([
    ("plant", "u8"), ("other", "u8"), ("object", "u8"), ("body", "i4"), ("link", "i4"), ("organ", "i4"),
    ("capsule", "i4"), ("point", "f8", 3), ("normal", "f8", 3), ("force", "f8", 3), ("moment", "f8", 3), ("gap", "f8")])
"""A row of World.forces, of one plant, capsule and body: plant, other: Plant.id, other 0 is a body; object: address of
the collision object; body, link: PyBullet's unique id and link, -1 for none and for the base; organ: index in
Model.organs; point on the plant [m]; normal from the body to the plant; force on the plant [N], the body has the
opposite; moment of that force about the world's origin [N m]; gap [m]."""
FORCE_ROW = np.dtype([
    ("plant", "u8"), ("other", "u8"), ("object", "u8"), ("body", "i4"), ("link", "i4"), ("capsule", "i4"),
    ("point", "f8", 3), ("normal", "f8", 3), ("force", "f8", 3), ("moment", "f8", 3), ("gap", "f8")], align=True)
assert FORCE_ROW.itemsize == ffi.sizeof("frond_force")


@documented
class World:
    """A world that Frond steps. frond.pybullet.attach gives one that PyBullet steps.

    It lives as long as something refers to it or to a thing in it, or until destroy.
    """

    _handle: Any
    _guards: tuple[Any, Any] | None = None  # of a world that another thread steps: while read, and while changed

    def __init__(self, **options: Unpack[WorldDefOptions]) -> None:
        """Makes an empty world; keyword arguments are those of WorldDefOptions. +y is up unless gravity says else."""
        out = ffi.new("frond_world *")
        check(lib.frond_world_create(make_def("world", "W", options), out))
        self._own(out)

    def _own(self, out: Any) -> None:
        self._handle = out[0]
        self._models: dict[int, Any] = {}  # of plants, by id
        self._organs: dict[int, Any] = {}  # of their capsules
        self._callbacks: dict[str, Any] = {}
        self._raised: BaseException | None = None
        identity = int(out.id)
        self._end = weakref.finalize(self, end_world, identity)
        self._end.atexit = False

    def _world_guard(self, function: Callable) -> Any:
        if self._guards is None:
            return None
        return self._guards[getattr(function, "_changes_world", False)]

    def __enter__(self) -> World:
        return self

    def __exit__(self, *_: Any) -> None:
        self.destroy()

    @changes_world
    def destroy(self) -> None:
        """Destroys the world with all that is in it; handles become stale. A second call does nothing."""
        self._end()

    @property
    def is_valid(self) -> bool:
        """Whether the world exists: PyBullet deletes its own on resetSimulation and disconnect."""
        return host.frond_host_is_alive(self._handle) and lib.frond_world_is_valid(self._handle)

    @property
    def bullet_world(self) -> int:
        """The address of the btDynamicsWorld, 0 for a stale world."""
        return int(ffi.cast("uintptr_t", host.frond_host_get_world(self._handle)))

    def step(self, dt: float = 1 / 60) -> None:
        """Advances by exactly dt [s], in equal substeps. A world of PyBullet's is stepped by stepSimulation."""
        host.frond_host_begin_call(self._handle)
        check(lib.frond_world_step(self._handle, real(dt, "dt")))
        self._raise_again()

    def _raise_again(self) -> None:
        error, self._raised = self._raised, None
        if error is not None:
            raise error

    # ---- what is in it

    @changes_world
    def add_plant(self, model: Model, **options: Unpack[PlantDefOptions]) -> Plant:
        """Makes a plant of a model; keyword arguments are those of PlantDefOptions."""
        from .model import Model
        from .plant import Plant

        if not isinstance(model, Model):
            model = Model(model)
        out = ffi.new("frond_plant *")
        check(lib.frond_plant_create(self._handle, model._handle, make_def("plant", "P", options), out))
        self._models[int(out.id)] = model
        self._organs[int(out.id)] = model.capsule_organs
        return Plant(out[0], self)

    @changes_world
    def add_rigid(self, **options: Unpack[RigidOptions]) -> Rigid:
        """Makes a rigid body; keyword arguments are those of RigidDefOptions, and those of its state."""
        from .rigid import Rigid

        names = ("position", "rotation", "velocity", "angular_velocity")
        definition = make_def("rigid", "R", {name: value for name, value in options.items() if name not in names})
        fill(definition.state, {name: value for name, value in options.items() if name in names}, "a state")
        out = ffi.new("frond_rigid *")
        check(lib.frond_rigid_create(self._handle, definition, out))
        return Rigid(out[0], self)

    @changes_world
    def add_robot(self, path: Any, **options: Unpack[RobotDefOptions]) -> Robot:
        """Loads a robot from a URDF file; keyword arguments are those of RobotDefOptions."""
        from .model import find_model, path_of
        from .robot import Robot

        out = ffi.new("frond_robot *")
        name = path_of(find_model(path))
        check(lib.frond_robot_load(self._handle, name, make_def("robot", "U", options), out))
        return Robot(out[0], self)

    @property
    def plants(self) -> list[Plant]:
        """All plants, in the order in which they were made."""
        from .plant import Plant

        count = lib.frond_world_get_plant_count(self._handle)
        out = ffi.new("frond_plant[]", max(count, 1))
        check(lib.frond_world_get_plants(self._handle, out, count))
        return [Plant(out[i], self) for i in range(count)]

    # ---- what acts on it

    def set_gravity(self, gravity: Vector) -> None:
        """Sets gravity [m/s^2]; of a world of PyBullet's for all its bodies."""
        check(lib.frond_world_set_gravity(self._handle, vector(gravity, "gravity")))

    def set_effects(self, effects: Effect | int) -> None:
        """Sets a mask over every plant's effects."""
        check(lib.frond_world_set_effects(self._handle, mask_of(effects, "effects")))

    def set_interpolation(self, fraction: float) -> None:
        """Sets which moment surfaces show: 0 the begin of the last substep, 1 its end; or AS_MOTION_STATES."""
        check(lib.frond_world_set_interpolation(self._handle, real(fraction, "fraction")))

    def set_wind(self, **options: Unpack[WindDefOptions]) -> None:
        """Gives the world air, with a wind; keyword arguments are those of WindDefOptions."""
        check(lib.frond_world_set_wind(self._handle, make_def("wind", "A", options)))

    def remove_wind(self) -> None:
        """Takes wind, its field and the air away."""
        check(lib.frond_world_set_wind(self._handle, ffi.NULL))
        self._callbacks.pop("wind", None)

    def set_wind_field(self, field: Callable[[Array, float, Array], Array] | None) -> None:
        """Sets a wind of your own: field(points n x 3 [m], time [s], velocities n x 3 [m/s] of the world's wind there)
        returns velocities n x 3 [m/s]. What it raises is raised by the next call of step or get_wind_at."""
        if field is None:
            check(lib.frond_world_set_wind_field(self._handle, ffi.NULL, ffi.NULL))
            self._callbacks.pop("wind", None)
            return
        if not callable(field):
            raise refuse(f"field is {field!r}; pass a function or None")
        owner = weakref.ref(self)

        def call(points: Any, count: int, time: float, velocities: Any, _: Any) -> None:
            array = np.frombuffer(ffi.buffer(velocities, 24 * count)).reshape(count, 3)
            try:
                at = np.frombuffer(ffi.buffer(points, 24 * count)).reshape(count, 3).copy()
                array[:] = numbers(field(at, time, array.copy()), "the field's velocities", (count, 3))
            except BaseException as error:  # cannot pass through C
                world = owner()
                if world is not None:
                    world._raised = error

        function = ffi.callback("frond_wind_field_fn", call)
        check(lib.frond_world_set_wind_field(self._handle, function, ffi.NULL))
        self._callbacks["wind"] = function

    def get_wind_at(self, point: Vector) -> Array:
        """Returns the velocity of the air at a point [m] and now [m/s]."""
        out = ffi.new("frond_vec3 *")
        check(lib.frond_world_get_wind_at(self._handle, vector(point, "point"), out))
        self._raise_again()
        return to_python(out[0])

    def shift_origin(self, origin: Vector) -> None:
        """Moves the world's origin to a point of it [m]."""
        check(lib.frond_world_shift_origin(self._handle, vector(origin, "origin")))

    def set_detail(self, distance: Callable[[Plant, float], float] | None = None,
                   **options: Unpack[DetailDefOptions]) -> None:
        """Sets from which distances on plants have less detail; keyword arguments are those of DetailDefOptions.
        distance(plant, metres) returns the distance that is to count."""
        definition = make_def("detail", "D", options)
        function = None
        if distance is not None:
            owner = weakref.ref(self)

            def call(plant: Any, metres: float, _: Any) -> float:
                world = owner()
                try:
                    return float(distance(wrap_handle["frond_plant"](plant, world), metres))
                except BaseException as error:  # cannot pass through C
                    if world is not None:
                        world._raised = error
                    return metres

            function = definition.distance = ffi.callback("frond_detail_fn", call)
        check(lib.frond_world_set_detail(self._handle, definition))
        self._callbacks["detail"] = function

    def remove_detail(self) -> None:
        """Has all plants simulated in full again."""
        check(lib.frond_world_set_detail(self._handle, ffi.NULL))
        self._callbacks.pop("detail", None)

    def set_viewer(self, position: Vector) -> None:
        """Sets the viewer's place [m], by which plants have more or less detail."""
        check(lib.frond_world_set_viewer(self._handle, vector(position, "position")))

    # ---- what it did

    @property
    def report(self) -> Report:
        """Counts of the last substep."""
        out = ffi.new("frond_report *")
        check(lib.frond_world_get_report(self._handle, out))
        return to_python(out[0])

    @property
    def energy_ledger(self) -> EnergyLedger:
        """Energy of all plants, and all work done on them since this was first read [J]."""
        out = ffi.new("frond_energy_ledger *")
        check(lib.frond_world_get_energy_ledger(self._handle, out))
        return to_python(out[0])

    @property
    def profile(self) -> Profile:
        """Wall clock of the last substep [ms]."""
        out = ffi.new("frond_profile *")
        check(lib.frond_world_get_profile(self._handle, out))
        return to_python(out[0])

    @property
    def state_hash(self) -> int:
        """A number that is equal for two worlds that simulated identically."""
        out = ffi.new("uint64_t *")
        check(lib.frond_world_get_state_hash(self._handle, out))
        return int(out[0])

    def cast_ray(self, origin: Vector, direction: Vector, max_distance: float) -> RayHit | None:
        """Finds the nearest plant along a ray [m]; None: none."""
        out = ffi.new("frond_ray_hit *")
        check(lib.frond_world_cast_ray(self._handle, vector(origin, "origin"), vector(direction, "direction"),
                                       real(max_distance, "max_distance"), out))
        return to_python(out[0], self) if out.plant.id else None

    def take_events(self) -> list[EventInfo]:
        """Takes what happened to plants since the last call; recorded from the first call on."""
        count = lib.frond_world_get_event_count(self._handle)
        out = ffi.new("frond_event_info[]", max(count, 1))
        check(lib.frond_world_take_events(self._handle, out, count))
        return [to_python(out[i], self) for i in range(count)]

    # ---- forces

    def forces(self, mean: bool = True, plant: Plant | None = None, body: int | None = None,
               link: int | None = None) -> np.ndarray:
        """Returns the table of contact forces, rows of FORCE_TYPE: means over the last call of step or stepSimulation,
        or mean=False of its last substep; of one plant, body and link of PyBullet's, if given. Recorded from the first
        call of this method on, in a world of PyBullet's from attach on."""
        from .plant import Plant

        mean = flag(mean, "mean")
        check_host(host.frond_host_record(self._handle))
        count = host.frond_host_get_force_count(self._handle, mean)
        out = ffi.new("frond_force[]", max(count, 1))
        check_host(host.frond_host_get_forces(self._handle, mean, out, count))
        rows = np.frombuffer(ffi.buffer(out, ffi.sizeof("frond_force") * count), FORCE_ROW)
        table = np.zeros(count, FORCE_TYPE)
        for name in set(FORCE_ROW.names or ()) & set(FORCE_TYPE.names or ()):
            table[name] = rows[name]
        table["organ"] = -1
        for number in np.unique(rows["plant"]):
            its = rows["plant"] == number
            organs = self._organs.get(int(number))
            if organs is not None:
                table["organ"][its] = organs[rows["capsule"][its]]
        keep = np.ones(count, bool)
        if plant is not None:
            keep &= table["plant"] == need(plant, Plant, "plant").id
        if body is not None:
            keep &= (table["body"] == integer(body, "body")) & (table["other"] == 0)
        if link is not None:
            keep &= table["link"] == integer(link, "link")
        return table[keep]

    def wrench_on(self, body: int, link: int = -1, about: Vector = (0, 0, 0), mean: bool = True) -> Wrench:
        """Returns the force of all plants on a link of a body of PyBullet's [N], and its moment about a point [N m]:
        mean over the last call, or of its last substep."""
        table = self.forces(mean, body=integer(body, "body"), link=integer(link, "link"))
        force = -table["force"].sum(axis=0)
        moment = -table["moment"].sum(axis=0) - np.cross(vector(about, "about"), force)
        return Wrench(force, moment)

    # ---- snapshots

    def save(self) -> bytes:
        """Saves all that steps change: plants, bodies that Frond made, time and gusts; PyBullet's bodies are not in it,
        see frond.pybullet.save."""
        size = lib.frond_world_get_snapshot_size(self._handle)
        out = ffi.new("uint8_t[]", max(size, 1))
        check(lib.frond_world_save(self._handle, out, size))
        return bytes(ffi.buffer(out, size))

    def restore(self, snapshot: bytes) -> None:
        """Restores what save gave, in a world with the same things made in the same order."""
        if not isinstance(snapshot, (bytes, bytearray, memoryview)):
            raise refuse(f"snapshot is {type(snapshot).__name__}; pass the bytes of save")
        data = bytes(snapshot)
        check(lib.frond_world_restore(self._handle, data, len(data)))


def end_world(identity: int) -> None:
    handle = ffi.new("frond_world *", [identity])[0]
    host.frond_host_release(handle)
    lib.frond_world_destroy(handle)


__all__ = ["AS_MOTION_STATES", "Error", "FORCE_TYPE", "World", "Wrench"]
