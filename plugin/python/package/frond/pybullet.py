"""Plants in the world of PyBullet, unmodified.

    client = pybullet.connect(pybullet.DIRECT)      # or GUI
    world = frond.pybullet.attach(client)
    plant = world.add_plant("corn", position=(0.5, 0, 0))
    pybullet.stepSimulation()                       # plants step in each of its substeps
    world.forces(body=robot)                        # and push, and are pushed

PyBullet's z is up: attach sets nothing, and gravity says what is down; plants stand on it by themselves. After
resetSimulation or disconnect all handles are stale: attach again.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pybullet as p

from ._generated import Result
from ._lib import (HOST_PATH, Error, changes_world, check_host, documented, ffi, host, integer, make_def, need, real,
                   refuse)
from .thing import Held
from .world import World

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._generated import PlantDefOptions, WorldDefOptions
    from .model import Model
    from .plant import Plant

_worlds: dict[int, PyBulletWorld] = {}  # by client


class Paused:
    """Stops PyBullet's real-time simulation while its world is changed by this thread."""

    def __init__(self, world: PyBulletWorld) -> None:
        self.world = world
        self.depth = 0
        self.ran = False

    def __enter__(self) -> None:
        self.depth += 1
        if self.depth > 1 or not p.isConnected(self.world.client):
            return
        parameters = p.getPhysicsEngineParameters(physicsClientId=self.world.client)
        self.ran = bool(parameters.get("useRealTimeSimulation"))
        if self.ran:
            p.setRealTimeSimulation(0, physicsClientId=self.world.client)

    def __exit__(self, *_: Any) -> None:
        self.depth -= 1
        if self.depth == 0 and self.ran and p.isConnected(self.world.client):
            p.setRealTimeSimulation(1, physicsClientId=self.world.client)


def upright(gravity: Any) -> tuple[float, float, float, float]:
    """Returns the rotation that turns a model's +y against gravity; PyBullet's +z without gravity."""
    up = -np.asarray(gravity, float)
    up = up / np.linalg.norm(up) if np.linalg.norm(up) > 0 else np.array([0.0, 0.0, 1.0])
    axis, cosine = np.cross([0, 1, 0], up), up[1]
    if cosine < -0.999999:
        return (1.0, 0.0, 0.0, 0.0)
    turn = np.array([*axis, 1 + cosine])
    return tuple((turn / np.linalg.norm(turn)).tolist())


def product(a: Any, b: Any) -> tuple[float, ...]:
    """Returns the rotation b, then a; x y z w."""
    turn = np.concatenate([a[3] * np.asarray(b[:3]) + b[3] * np.asarray(a[:3]) + np.cross(a[:3], b[:3]),
                           [a[3] * b[3] - np.dot(a[:3], b[:3])]])
    return tuple(turn.tolist())


@documented
class PyBulletWorld(World):
    """The plants of a client of PyBullet's; attach makes it. `client` is PyBullet's number of it."""

    client: int

    def __init__(self) -> None:
        raise refuse("call frond.pybullet.attach(client)")

    @changes_world
    def add_plant(self, model: Model, **options: Unpack[PlantDefOptions]) -> Plant:
        """Makes a plant of a model, or of the name of a file. Without a rotation it stands upright against gravity, +z
        where there is none; a rotation turns it from there."""
        gravity = np.array([0.0, 0.0, -1.0])
        found = p.getPhysicsEngineParameters(physicsClientId=self.client) if p.isConnected(self.client) else {}
        if any(found.get(f"gravityAcceleration{axis}", 0) for axis in "XYZ"):
            gravity = np.array([found[f"gravityAcceleration{axis}"] for axis in "XYZ"])
        rotation = options.get("rotation", (0, 0, 0, 1))
        if np.shape(rotation) != (4,):
            raise refuse(f"rotation is {rotation!r}; pass x, y, z, w")
        options["rotation"] = product(rotation, upright(gravity))
        plant = World.add_plant(self, model, **options)
        host.frond_host_hide(plant._handle)
        return plant


def attach(client: int = 0, **options: Unpack[WorldDefOptions]) -> PyBulletWorld:
    """Returns the plants of a client's world, to which they are attached on the first call, and after a reset or a new
    connection. DIRECT and GUI; discrete, soft and deformable worlds. Keyword arguments are those of WorldDefOptions;
    gravity and max_substep are PyBullet's own."""
    client = integer(client, "client")
    info = p.getConnectionInfo(physicsClientId=client)
    if not info["isConnected"]:
        raise refuse(f"PyBullet has no client {client}; pass what pybullet.connect returned")
    known = _worlds.get(client)
    if known is not None and known.is_valid:
        if options:
            raise refuse("this client has plants already; settings are for the first attach after a reset")
        return known
    if info["connectionMethod"] not in (p.DIRECT, p.GUI):
        raise Error(Result.UNSUPPORTED, "plants need PyBullet's world in this process; connect by DIRECT or GUI")
    plugin = p.loadPlugin(HOST_PATH, "_frond", physicsClientId=client)
    if plugin < 0:
        raise Error(Result.UNSUPPORTED, "PyBullet does not load the plugin; use PyBullet 3.2.6 and 3.2.7")
    number = p.executePluginCommand(plugin, "attach", physicsClientId=client)
    world = PyBulletWorld.__new__(PyBulletWorld)
    world.client = client
    out = ffi.new("frond_world *")
    paused = Paused(world)
    with paused:
        check_host(host.frond_host_attach(number, make_def("world", "W", dict(options)), out))
        world._own(out)
        check_host(host.frond_host_record(out[0]))
    if info["connectionMethod"] == p.GUI:
        world._guards = (Held(world), paused)
    _worlds[client] = world
    return world


def detach(client: int = 0) -> None:
    """Destroys the plants of a client; its world goes on without them."""
    world = _worlds.pop(integer(client, "client"), None)
    if world is not None:
        world.destroy()


class Saved(NamedTuple):
    """A state of PyBullet's world and its plants together."""

    state: int
    plants: bytes


def living(world: PyBulletWorld) -> PyBulletWorld:
    """Returns a world that exists; refuses others."""
    if not need(world, PyBulletWorld, "world").is_valid:
        raise Error(Result.BAD_HANDLE, "the world is stale: PyBullet was reset or disconnected; attach again")
    return world


def save(world: PyBulletWorld) -> Saved:
    """Saves robots and all else of PyBullet's in memory by its saveState, and the plants by a snapshot."""
    plants = living(world).save()
    return Saved(p.saveState(physicsClientId=world.client), plants)


def restore(world: PyBulletWorld, saved: Saved) -> None:
    """Goes back to what save gave. Plants and a ball that hits them repeat to the bit; Bullet starts its solver for
    multi-bodies and its contacts anew, so that a robot's joints among plants repeat to some 1e-5 rad after half a
    second."""
    client, state = living(world).client, need(saved, Saved, "saved").state
    before = p.saveState(physicsClientId=client)
    try:
        p.restoreState(stateId=state, physicsClientId=client)
        world.restore(saved.plants)
    except p.error:
        raise refuse("PyBullet does not have this state; it was removed, is of before a reset, or bodies were added or "
                     "removed since") from None
    except Error:
        p.restoreState(stateId=before, physicsClientId=client)
        raise
    finally:
        p.removeState(before, physicsClientId=client)


def remove_saved(world: PyBulletWorld, saved: Saved) -> None:
    """Frees what save keeps in PyBullet."""
    p.removeState(need(saved, Saved, "saved").state, physicsClientId=living(world).client)


class Drawing:
    """Plants in PyBullet's window: the points of their surfaces, moved by each update."""

    def __init__(self, world: PyBulletWorld, point_size: float = 3, most: int = 6000) -> None:
        self.world = living(world)
        self.point_size, self.most = real(point_size, "point_size"), integer(most, "most")
        if self.point_size <= 0 or self.most < 1:
            raise refuse("point_size and most have to be above zero")
        self.items: dict[int, int] = {}  # by plant

    def update(self) -> None:
        """Draws all plants as they are now, in green, and removes those that are gone."""
        plants = {plant.id: plant for plant in self.world.plants}
        for gone in set(self.items) - set(plants):
            p.removeUserDebugItem(self.items.pop(gone), physicsClientId=self.world.client)
        for identity, plant in plants.items():
            surface = plant.surface
            corners = surface.positions[surface.triangles]
            middles = (corners + np.roll(corners, 1, axis=1)).reshape(-1, 3) / 2
            points = np.concatenate([surface.positions, corners.mean(axis=1), middles])
            points = points[:: max(1, -(-len(points) // self.most))].astype(float)
            height = points[:, 2] - points[:, 2].min()
            shade = 0.35 + 0.4 * height / max(height.max(), 1e-9)
            colors = np.stack([0.45 * shade, shade, 0.25 * shade], axis=1)
            options = {"replaceItemUniqueId": self.items[identity]} if identity in self.items else {}
            self.items[identity] = p.addUserDebugPoints(points.tolist(), colors.tolist(), self.point_size,
                                                        physicsClientId=self.world.client, **options)


def camera_image(world: PyBulletWorld, width: int, height: int, view: Any, projection: Any, **options: Any) -> Any:
    """Takes a picture of PyBullet's bodies and Frond's plants: see frond.camera."""
    from .camera import camera_image as take

    return take(world, width, height, view, projection, **options)


__all__ = ["Drawing", "PyBulletWorld", "Saved", "attach", "camera_image", "detach", "remove_saved", "restore", "save"]
