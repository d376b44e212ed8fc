"""PyBullet's camera with plants in the picture. Frond's renderer draws plants and bodies together; of bodies whose shape
PyBullet does not tell, PyBullet's picture shows what is nearer."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, NamedTuple, Sequence

import numpy as np
import numpy.typing as npt
import pybullet as p

from ._lib import flag, integer, refuse
from .picture import LARGEST, Picture, camera_of_matrices

if TYPE_CHECKING:
    from .pybullet import PyBulletWorld

MOST_ORGANS = 1 << 12  # of one plant


class Image(NamedTuple):
    """What PyBullet's camera sees of its bodies and of Frond's plants."""

    rgb: npt.NDArray[np.uint8]
    """height x width x 3"""
    distance: npt.NDArray[np.float32]
    """Along the camera's axis [m], height x width; the far plane's where nothing is."""
    bodies: npt.NDArray[np.int32]
    """PyBullet's segmentation, height x width: unique ids of bodies, -1 where a plant or nothing is."""
    plants: npt.NDArray[np.int32]
    """The plant that is seen, its index in World.plants, height x width; -1: none."""
    organs: npt.NDArray[np.int32]
    """Its organ, an index in Model.organs; -1: none."""


@functools.lru_cache(maxsize=4)
def canvas(width: int, height: int) -> Picture:
    return Picture(width, height, samples=1, sky_samples=8)


def planes_of(projection: Any) -> tuple[float, float]:
    """Returns the distances of the near and the far plane [m]."""
    matrix = np.asarray(projection, float).reshape(4, 4).T
    return matrix[2, 3] / (matrix[2, 2] - 1), matrix[2, 3] / (matrix[2, 2] + 1)


def picture_of_pybullet(client: int, width: int, height: int, view: Any, projection: Any, options: Any) -> Image:
    near, far = planes_of(projection)
    taken = p.getCameraImage(width, height, view, projection, physicsClientId=client, **options)
    rgb = np.array(taken[2], np.uint8).reshape(height, width, 4)[:, :, :3]
    depth = np.asarray(taken[3], float).reshape(height, width)
    none = np.full((height, width), -1, np.int32)
    return Image(rgb, (far * near / (far - (far - near) * depth)).astype(np.float32),
                 np.asarray(taken[4]).reshape(height, width).astype(np.int32), none, none)


def labels_of(shapes: list[tuple[int, int, bool]], options: Any) -> npt.NDArray[np.int32]:
    """Returns PyBullet's segmentation of each visual shape."""
    with_links = options.get("flags", 0) & p.ER_SEGMENTATION_MASK_OBJECT_AND_LINKINDEX
    return np.array([body + ((link + 1) << 24 if with_links else 0) for body, link, _ in shapes] + [-1], np.int32)


def picture_of_frond(world: PyBulletWorld, width: int, height: int, camera: Any, far: float, with_bodies: bool,
                     options: Any) -> tuple[Image, list[tuple[int, int, bool]]]:
    """Draws plants, and bodies if wanted. Returns the visual shapes too: body, link and whether it was drawn."""
    picture = canvas(width, height)
    shapes: list[tuple[int, int, bool]] = []
    with picture.frame(camera=camera, ground=False, up=(0, 0, 1)):
        if with_bodies:
            try:
                from .bodies import draw_bodies
            except ImportError as error:
                raise refuse(f"bodies are drawn with the packages trimesh and pillow, of which one is missing: {error}; "
                             "install them, or pass draw_bodies=False") from None

            shapes = list(draw_bodies(picture, world.client, 0))
        for number, plant in enumerate(world.plants):
            picture.draw_organs(plant, len(shapes) + number * MOST_ORGANS)
        picture.set_id(0)
    ids, distance = picture.ids, picture.distances
    seen = (ids >= 0) & (distance < far)
    is_plant = seen & (ids >= len(shapes))
    organs = ids - len(shapes)
    bodies = labels_of(shapes, options)[np.where(seen & ~is_plant, ids, -1)]
    return Image(picture.pixels, np.where(seen, distance, far).astype(np.float32), bodies,
                 np.where(is_plant, organs // MOST_ORGANS, -1), np.where(is_plant, organs % MOST_ORGANS, -1)), shapes


def nearer(front: Image, back: Image, shows: npt.NDArray[np.bool_]) -> Image:
    """Returns the back image with what `shows` of the front one."""
    pairs: Any = zip(front, back)
    return Image(*(np.where(shows[:, :, None] if a.ndim == 3 else shows, a, b) for a, b in pairs))


def camera_image(world: PyBulletWorld, width: int, height: int, view: Sequence[float], projection: Sequence[float],
                 draw_bodies: bool = True, **options: Any) -> Image:
    """Takes a picture by PyBullet's view and projection matrices, one of computeProjectionMatrixFOV.

    Frond draws the bodies with their colours and textures as their files have them, and plants and bodies cast shadows
    on each other. Bodies of which PyBullet tells no triangles, soft ones and meshes given as arrays, come from
    PyBullet's own picture, as do all of them with draw_bodies=False: then in each pixel what is nearer counts. Other
    keyword arguments are those of pybullet.getCameraImage, for its picture; its `flags` count for both."""
    from .pybullet import living

    living(world)
    for name, size in (("width", width), ("height", height)):
        if not 1 <= integer(size, name) <= LARGEST:
            raise refuse(f"{name} is {size}; pass 1 to {LARGEST} pixels")
    camera = camera_of_matrices(view, projection)
    near, far = planes_of(projection)
    drawn, shapes = picture_of_frond(world, width, height, camera, far, flag(draw_bodies, "draw_bodies"), options)
    known = {body for body, _, is_drawn in shapes if is_drawn}
    bodies = {p.getBodyUniqueId(i, physicsClientId=world.client)
              for i in range(p.getNumBodies(physicsClientId=world.client))}
    left = {body for body, _, is_drawn in shapes if not is_drawn} | (bodies - known)
    if not left:
        return drawn
    theirs = picture_of_pybullet(world.client, width, height, view, projection, options)
    if not draw_bodies:
        return nearer(drawn, theirs, (drawn.plants >= 0) & (drawn.distance < theirs.distance))
    is_left = np.isin(np.where(theirs.bodies >= 0, theirs.bodies & ((1 << 24) - 1), -1), list(left))
    return nearer(theirs, drawn, is_left & (theirs.distance < drawn.distance))


__all__ = ["Image", "camera_image"]
