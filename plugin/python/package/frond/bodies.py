"""PyBullet's bodies as triangles, for pictures of them by Frond's renderer."""

from __future__ import annotations

import functools
import io
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, NamedTuple

import numpy as np
import pybullet as p
import trimesh

from ._lib import Array

if TYPE_CHECKING:
    from .picture import Picture

PLANE = 100.0  # half width with which an infinite plane is drawn [m]
GAMMA = 2.2  # of PyBullet's colours
WHITE = 0.7  # share of light that PyBullet's white sends back
FLAT = 1e-6  # height of a floor over its width


class Piece(NamedTuple):
    """Triangles of one appearance, in the frame of their file or shape."""

    positions: Array
    triangles: Array
    normals: Array | None
    """None: flat faces."""
    uvs: Array | None
    color: Array | None
    """Red, green, blue 0 .. 1 of its own; None: the body's."""
    texture: bytes | None
    """A PNG file."""


class Unknown(Exception):
    """A shape that PyBullet does not tell enough of."""


def normals_of(vertices: Array, faces: Array) -> Array:
    """Returns normals at vertices, of the triangles around each by their areas."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, faces[:, k].astype(np.int64), np.cross(b - a, c - a))
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


def piece_of(mesh: Any, is_flat: bool) -> Piece:
    material = getattr(mesh.visual, "material", None)
    image, uvs = getattr(material, "image", None), getattr(mesh.visual, "uv", None)
    vertices, faces = np.asarray(mesh.vertices, float), np.asarray(mesh.faces)
    normals = None if is_flat else normals_of(vertices, faces)
    if image is not None and uvs is not None:
        file = io.BytesIO()
        image.convert("RGB").save(file, "png")
        return Piece(vertices, faces, normals, np.asarray(uvs) * [1, -1] + [0, 1], None, file.getvalue())
    color = None if material is None else np.asarray(material.main_color[:3]) / 255
    return Piece(vertices, faces, normals, None, color, None)


@functools.lru_cache(maxsize=256)
def load_mesh(path: str, _: float) -> tuple[Piece, ...]:
    """Loads a file of a mesh; the second argument is the time at which it was written."""
    loaded: Any = trimesh.load(path)
    meshes: Any = loaded.dump() if isinstance(loaded, trimesh.Scene) else [loaded]
    # A facet of an .stl has its own normal.
    return tuple(piece_of(mesh, path.lower().endswith(".stl")) for mesh in meshes if len(mesh.faces))


@functools.lru_cache(maxsize=256)
def make_shape(kind: int, dimensions: tuple[float, ...]) -> tuple[Piece, ...]:
    """Makes a primitive shape of PyBullet's."""
    make = trimesh.creation
    if kind == p.GEOM_SPHERE:
        return (piece_of(make.uv_sphere(dimensions[0]), False),)
    if kind == p.GEOM_BOX:
        return (piece_of(make.box(dimensions), True),)
    if kind == p.GEOM_CYLINDER:
        return (piece_of(make.cylinder(dimensions[1], dimensions[0]), True),)
    if kind == p.GEOM_CAPSULE:
        return (piece_of(make.capsule(dimensions[0], dimensions[1]), False),)
    if kind == p.GEOM_PLANE:
        corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * PLANE
        return (piece_of(trimesh.Trimesh(corners, [[0, 1, 2], [0, 2, 3]]), True),)
    raise Unknown


def pieces_of(shape: Any) -> tuple[tuple[Piece, ...], Array]:
    """Returns the pieces of an entry of getVisualShapeData, and their scale."""
    if shape[2] != p.GEOM_MESH:
        return make_shape(shape[2], tuple(shape[3])), np.ones(3)
    path = Path(shape[4].decode())
    try:
        return load_mesh(str(path), path.stat().st_mtime), np.asarray(shape[3])
    except Exception as error:  # of all kinds, by files that nobody checked
        raise Unknown from error


def frame_of(body: int, link: int, client: int) -> tuple[Any, Any]:
    """Returns position and rotation of a link's frame."""
    if link >= 0:
        state = p.getLinkState(body, link, physicsClientId=client)
        return state[4], state[5]
    centre = p.getDynamicsInfo(body, -1, physicsClientId=client)[3:5]
    return p.multiplyTransforms(*p.getBasePositionAndOrientation(body, physicsClientId=client),
                                *p.invertTransform(*centre))


def draw_bodies(picture: Picture, client: int, first_id: int) -> Iterator[tuple[int, int, bool]]:
    """Draws all bodies, each visual shape with a number of its own from first_id on. Returns the body and link of each,
    and whether it was drawn."""
    for index in range(p.getNumBodies(physicsClientId=client)):
        body = p.getBodyUniqueId(index, physicsClientId=client)
        for shape in p.getVisualShapeData(body, physicsClientId=client):
            picture.set_id(first_id)
            first_id += 1
            try:
                pieces, scale = pieces_of(shape)
            except Unknown:
                yield body, shape[1], False
                continue
            place, turn = p.multiplyTransforms(*frame_of(body, shape[1], client), shape[5], shape[6])
            draw_pieces(picture, pieces, scale, np.reshape(p.getMatrixFromQuaternion(turn), (3, 3)), place, shape[7])
            yield body, shape[1], True


def draw_pieces(picture: Picture, pieces: tuple[Piece, ...], scale: Array, turn: Array, place: Any,
                tint: Any) -> None:
    textures = picture._textures_of(pieces, lambda: [piece.texture for piece in pieces])
    for piece, texture in zip(pieces, textures):
        color = np.asarray(tint[:3])
        if piece.color is not None and tuple(tint[:3]) == (1, 1, 1):
            color = piece.color
        positions = (piece.positions * scale) @ turn.T + place
        normals = None if piece.normals is None else (piece.normals / scale) @ turn.T
        part = {"first_triangle": 0, "triangle_count": len(piece.triangles), "texture": texture, "gloss": 0.3,
                "color": (*(WHITE * color**GAMMA).tolist(), 1.0),
                "is_floor": np.ptp(positions[:, 2]) < FLAT * np.ptp(positions[:, 0])}
        picture.draw_mesh(positions, piece.triangles, normals, piece.uvs, None, [part])


__all__ = ["draw_bodies"]
