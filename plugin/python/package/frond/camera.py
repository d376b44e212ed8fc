"""PyBullet's camera with plants in the picture: PyBullet draws its bodies, Frond the plants, and the nearer counts."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, NamedTuple, Sequence

import numpy as np
import numpy.typing as npt
import pybullet as p

from ._lib import integer, refuse
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


def camera_image(world: PyBulletWorld, width: int, height: int, view: Sequence[float], projection: Sequence[float],
                 **options: Any) -> Image:
    """Takes a picture by PyBullet's view and projection matrices; other keyword arguments are those of
    pybullet.getCameraImage. The projection is one of computeProjectionMatrixFOV."""
    for name, size in (("width", width), ("height", height)):
        if not 1 <= integer(size, name) <= LARGEST:
            raise refuse(f"{name} is {size}; pass 1 to {LARGEST} pixels")
    from .pybullet import living

    living(world)
    camera = camera_of_matrices(view, projection)
    matrix = np.asarray(projection, float).reshape(4, 4).T
    near, far = matrix[2, 3] / (matrix[2, 2] - 1), matrix[2, 3] / (matrix[2, 2] + 1)
    taken = p.getCameraImage(width, height, view, projection, physicsClientId=world.client, **options)
    rgb = np.array(taken[2], np.uint8).reshape(height, width, 4)[:, :, :3]
    depth = np.asarray(taken[3], float).reshape(height, width)
    distance = (far * near / (far - (far - near) * depth)).astype(np.float32)
    bodies = np.asarray(taken[4]).reshape(height, width).astype(np.int32)

    picture = canvas(width, height)
    with picture.frame(camera=camera, ground=False, up=(0, 0, 1)):
        for number, plant in enumerate(world.plants):
            picture.draw_organs(plant, number * MOST_ORGANS)
        picture.set_id(0)
    ids, reach = picture.ids, picture.distances
    is_plant = (ids >= 0) & (reach < distance)
    rgb = np.where(is_plant[:, :, None], picture.pixels, rgb)
    return Image(rgb, np.where(is_plant, reach, distance), np.where(is_plant, -1, bodies),
                 np.where(is_plant, ids // MOST_ORGANS, -1), np.where(is_plant, ids % MOST_ORGANS, -1))


__all__ = ["Image", "camera_image"]
