"""Pictures without a display, by EGL.

    picture = frond.picture.Picture(800, 600)
    with picture.frame(camera=frond.picture.camera_on(plant)):
        picture.draw_plant(plant)
    picture.write("plant.png")
"""

from __future__ import annotations

import math
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Callable, Iterator, Sequence

import numpy as np
import numpy.typing as npt

from ._generated import PictureCamera, PicturePlatform, PictureWhat
from ._lib import (documented, ffi, fill, integer, mask_of, need, numbers, path_of, picture_library, real, refuse,
                   row_of, text_of, to_python, vector)
from .film import TOLERANCE, Film, check, compare, compare_file, read_png, write_png
from .hold import Grab
from .plant import Plant
from .rigid import Rigid
from .robot import Robot

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._generated import PictureDefOptions, PictureSceneOptions, Vector

LARGEST = 8192
"""Largest width and height of a picture [pixel]."""
FARTHEST = 1.0e6
"""Largest coordinate that is drawn [m]."""

Color = Sequence[float]
"""Linear red, green, blue and, if given, alpha, 0 .. 1."""


def color_of(color: Color) -> tuple[float, ...]:
    values = numbers(color, "the colour", (-1,)).tolist()
    if len(values) not in (3, 4):
        raise refuse("a colour has 3 or 4 numbers")
    return tuple((values + [1.0])[:4])


def camera_struct(camera: Any) -> Any:
    scene = picture_library().frond_default_picture_scene()  # kept, since its camera is a part of it
    struct = ffi.new("frond_picture_camera *", scene.camera)
    if not isinstance(camera, (dict, PictureCamera)):
        raise refuse(f"camera is {camera!r}; pass a PictureCamera or a dict of its fields")
    options = camera if isinstance(camera, dict) else {n: getattr(camera, n) for n in PictureCamera.__annotations__}
    return fill(struct[0], options, "a camera")


def camera_of_box(lower: Vector, upper: Vector, up: Vector = (0, 1, 0), azimuth: float = 0.5, elevation: float = 0.25,
                  aspect: float = 4 / 3) -> PictureCamera:
    """Returns a camera that sees a whole box [m]; azimuth and elevation [rad]."""
    return to_python(picture_library().frond_picture_frame(
        vector(lower, "lower"), vector(upper, "upper"), vector(up, "up"), real(azimuth, "azimuth"),
        real(elevation, "elevation"), real(aspect, "aspect")))


def camera_on(plant: Plant, up: Vector = (0, 1, 0), azimuth: float = 0.5, elevation: float = 0.25,
              aspect: float = 4 / 3) -> PictureCamera:
    """Returns a camera that sees a whole plant."""
    points = need(plant, Plant, "plant").surface.positions
    return camera_of_box(points.min(axis=0), points.max(axis=0), up, azimuth, elevation, aspect)


def camera_of_matrices(view: Sequence[float], projection: Sequence[float]) -> PictureCamera:
    """Returns the camera of PyBullet's view and projection matrices, 16 numbers each; the projection is to be a
    symmetric one with perspective, as computeProjectionMatrixFOV makes it."""
    v = numbers(view, "view", (16,)).reshape(4, 4).T
    projected = numbers(projection, "projection", (16,)).reshape(4, 4).T
    if projected[3, 2] != -1 or abs(projected[0, 2]) > 1e-9 or abs(projected[1, 2]) > 1e-9 or projected[1, 1] <= 0:
        raise refuse("projection is not a symmetric perspective; make it by computeProjectionMatrixFOV")
    up, back = v[1, :3], v[2, :3]
    eye = -v[:3, :3].T @ v[:3, 3]
    return PictureCamera(eye=eye, target=eye - back, up=up, field_of_view=2 * math.atan(1 / projected[1, 1]))


@documented
class Picture:
    """A canvas of width x height pixels. Draw between begin and end, or in `with picture.frame():`."""

    def __init__(self, width: int = 1280, height: int = 720, **options: Unpack[PictureDefOptions]) -> None:
        """Makes a canvas; the other keyword arguments are those of PictureDefOptions."""
        library = picture_library()
        struct = ffi.new("frond_picture_def *", library.frond_default_picture_def())
        fill(struct[0], {"width": width, "height": height, **options}, "a picture")
        out = ffi.new("frond_picture **")
        check(library.frond_picture_create(struct, out))
        self._picture = ffi.gc(out[0], library.frond_picture_destroy)
        self._textures: dict[int, tuple[Any, list[int]]] = {}

    def _world_guard(self, function: Any) -> None:
        return None

    def __enter__(self) -> Picture:
        return self

    def __exit__(self, *_: Any) -> None:
        self.destroy()

    def destroy(self) -> None:
        """Frees the canvas now."""
        picture_library().frond_picture_destroy(self._picture)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height [pixel]."""
        width, height = ffi.new("int *"), ffi.new("int *")
        check(picture_library().frond_picture_get_size(self._picture, width, height))
        return width[0], height[0]

    @property
    def renderer(self) -> str:
        """What draws, "surfaceless, OpenGL 4.5 ..."."""
        return text_of(picture_library().frond_picture_get_renderer(self._picture))

    def begin(self, **scene: Unpack[PictureSceneOptions]) -> None:
        """Discards what was drawn and begins a frame; keyword arguments are those of PictureSceneOptions, camera a
        PictureCamera or a dict of its fields."""
        struct = ffi.new("frond_picture_scene *", picture_library().frond_default_picture_scene())
        options: dict[str, Any] = dict(scene)
        camera = options.pop("camera", None)
        for name in ("sun", "sky", "background_top", "background_horizon", "ground_color"):
            if name in options:
                options[name] = color_of(options[name])
        fill(struct[0], options, "a scene")
        if camera is not None:
            struct.camera = camera_struct(camera)
        check(picture_library().frond_picture_begin(self._picture, struct))

    def end(self) -> None:
        """Draws the frame."""
        check(picture_library().frond_picture_end(self._picture))

    @contextmanager
    def frame(self, **scene: Unpack[PictureSceneOptions]) -> Iterator[Picture]:
        """Begins a frame, and draws it at the end of the block."""
        self.begin(**scene)
        yield self
        self.end()

    @property
    def pixels(self) -> npt.NDArray[np.uint8]:
        """The last finished frame, height x width x 3, copied."""
        return self._read(picture_library().frond_picture_get_pixels(self._picture), "u1", 3)

    def _read(self, pointer: Any, dtype: str, channels: int) -> Any:
        check(bool(pointer))
        width, height = self.size
        size = width * height * channels * np.dtype(dtype).itemsize
        shape = (height, width, channels) if channels > 1 else (height, width)
        return np.frombuffer(bytes(ffi.buffer(pointer, size)), dtype).reshape(shape)

    def write(self, png_path: Any) -> None:
        """Writes the last finished frame as a PNG."""
        check(picture_library().frond_picture_write(self._picture, path_of(png_path)))

    def set_id(self, number: int) -> None:
        """Gives all surfaces that are drawn from now on in this frame a number, for `ids` and `distances`."""
        check(picture_library().frond_picture_set_id(self._picture, integer(number, "number")))

    @property
    def ids(self) -> npt.NDArray[np.int32]:
        """The number of the surface in each pixel, height x width; -1: none."""
        return self._read(picture_library().frond_picture_get_ids(self._picture), "i4", 1)

    @property
    def distances(self) -> npt.NDArray[np.float32]:
        """The distance of the surface in each pixel along the camera's axis [m], height x width; infinite: none."""
        return self._read(picture_library().frond_picture_get_distances(self._picture), "f4", 1)

    def present(self, framebuffer: int, width: int, height: int) -> None:
        """Copies the last frame to a framebuffer of the caller's own context, of PicturePlatform.CURRENT."""
        check(picture_library().frond_picture_present(self._picture, mask_of(framebuffer, "framebuffer"),
                                                      integer(width, "width"), integer(height, "height")))

    # ---- surfaces

    def add_texture(self, image: bytes) -> int:
        """Adds the bytes of an image file. Returns the number by which parts name it."""
        need(image, bytes, "image")
        out = ffi.new("int *")
        check(picture_library().frond_picture_add_texture(self._picture, image, len(image), out))
        return out[0]

    def _textures_of(self, key: Any, images: Callable[[], Sequence[bytes | None]]) -> list[int]:
        """Adds images once for each key that is the same object. Returns their numbers, -1 for empty ones."""
        if id(key) not in self._textures:
            # The key is kept, or another one may have its id later.
            self._textures[id(key)] = (key, [self.add_texture(image) if image else -1 for image in images()])
        return self._textures[id(key)][1]

    def draw_mesh(self, positions: npt.ArrayLike, triangles: npt.ArrayLike, normals: npt.ArrayLike | None = None,
                  uvs: npt.ArrayLike | None = None, colors: npt.ArrayLike | None = None,
                  parts: Sequence[dict[str, Any]] = (), color: Color | None = None) -> None:
        """Draws triangles: positions n x 3 [m], triangles m x 3, normals n x 3, uvs n x 2, colors n x 4 of bytes;
        parts: dicts of the fields of PicturePart; or color: one for all."""
        mesh = ffi.new("frond_picture_mesh *")
        kept = []

        def put(name: str, value: Any, width: int, dtype: Any, c_type: str) -> int:
            if value is None:
                return 0
            array = numbers(value, name, (-1, width), dtype)
            kept.append(array)
            if array.size:
                setattr(mesh, "indices" if name == "triangles" else name, ffi.from_buffer(c_type, array))
            return len(array)

        mesh.vertex_count = put("positions", positions, 3, np.float32, "float[]")
        mesh.triangle_count = put("triangles", triangles, 3, np.int32, "int32_t[]")
        for name, value, width in (("normals", normals, 3), ("uvs", uvs, 2), ("colors", colors, 4)):
            is_bytes = name == "colors"
            kind = (np.uint8, "uint8_t[]") if is_bytes else (np.float32, "float[]")
            count = put(name, value, width, *kind)
            if value is not None and count != mesh.vertex_count:
                raise refuse(f"{name} has {count} rows; there are {mesh.vertex_count} positions")
        if color is not None:
            parts = [{"first_triangle": 0, "triangle_count": mesh.triangle_count, "color": color_of(color),
                      "gloss": 0.2, "texture": -1}]
        if not isinstance(parts, (list, tuple)) or not all(isinstance(part, dict) for part in parts):
            raise refuse(f"parts is {parts!r}; pass a list of dicts of the fields of PicturePart")
        array = ffi.new("frond_picture_part[]", max(len(parts), 1))
        for i, part in enumerate(parts):
            fill(array[i], {"texture": -1, **part}, "a part")
        if parts:
            mesh.parts, mesh.part_count = array, len(parts)
        check(picture_library().frond_picture_draw_mesh(self._picture, mesh))

    def draw_sphere(self, center: Vector, radius: float, color: Color) -> None:
        """Draws a sphere [m]."""
        check(picture_library().frond_picture_draw_sphere(self._picture, vector(center, "center"),
                                                          real(radius, "radius"), color_of(color)))

    def draw_box(self, center: Vector, half_extents: Vector, color: Color, rotation: Vector = (0, 0, 0, 1)) -> None:
        """Draws a box [m], turned by x y z w."""
        turn = tuple(numbers(rotation, "rotation", (4,)).tolist())
        check(picture_library().frond_picture_draw_box(self._picture, vector(center, "center"), turn,
                                                       vector(half_extents, "half_extents"), color_of(color)))

    def draw_capsule(self, begin: Vector, end: Vector, radius: float, color: Color) -> None:
        """Draws a capsule [m]."""
        check(picture_library().frond_picture_draw_capsule(self._picture, vector(begin, "begin"), vector(end, "end"),
                                                           real(radius, "radius"), color_of(color)))

    # ---- overlays

    def draw_line(self, begin: Vector, end: Vector, width: float, color: Color) -> None:
        """Draws a line [m] of a width [pixel]."""
        check(picture_library().frond_picture_draw_line(self._picture, vector(begin, "begin"), vector(end, "end"),
                                                        real(width, "width"), color_of(color)))

    def draw_arrow(self, begin: Vector, end: Vector, width: float, color: Color) -> None:
        """Draws a line with a head at its end, as for a force."""
        check(picture_library().frond_picture_draw_arrow(self._picture, vector(begin, "begin"), vector(end, "end"),
                                                         real(width, "width"), color_of(color)))

    def draw_point(self, point: Vector, size: float, color: Color) -> None:
        """Draws a dot of a diameter [pixel]."""
        check(picture_library().frond_picture_draw_point(self._picture, vector(point, "point"), real(size, "size"),
                                                         color_of(color)))

    def draw_tets(self, nodes: npt.ArrayLike, tets: npt.ArrayLike, width: float = 1.2,
                  line: Color = (0.02, 0.1, 0.32, 0.8), fill_color: Color = (0.1, 0.35, 0.8, 0.1)) -> None:
        """Draws a cage: nodes n x 3 [m], tets m x 4."""
        xyz, corners = numbers(nodes, "nodes", (-1, 3)), numbers(tets, "tets", (-1, 4), np.int32)
        check(picture_library().frond_picture_draw_tets(
            self._picture, ffi.from_buffer("double[]", xyz), len(xyz), ffi.from_buffer("int32_t[]", corners),
            len(corners), real(width, "width"), color_of(line), color_of(fill_color)))

    # ---- what Frond made

    def draw_plant(self, plant: Plant, what: PictureWhat | int = PictureWhat.SURFACE) -> None:
        """Draws a plant as it is now."""
        check(picture_library().frond_picture_draw_plant(self._picture, need(plant, Plant, "plant")._handle,
                                                         plant.model._handle, mask_of(what, "what")))

    def draw_organs(self, plant: Plant, first_id: int = 0) -> None:
        """Draws a plant's surface with a number for each organ, first_id and its index in Model.organs."""
        first_id = integer(first_id, "first_id")
        model, surface = need(plant, Plant, "plant").model, plant.surface
        textures = self._textures_of(model, lambda: [texture.bytes for texture in model.textures])
        organs = {organ.name: i for i, organ in enumerate(model.organs)}
        for part in model.parts:
            is_thin = part.kind in ("blade", "crown", "flower", "tendril")
            self.set_id(first_id + organs.get(part.organ, 0))
            used = surface.triangles[part.first_triangle:part.first_triangle + part.triangle_count]
            self.draw_mesh(surface.positions, used, surface.normals, surface.uvs, surface.colors,
                           [{"first_triangle": 0, "triangle_count": len(used), "color": part.color,
                             "texture": textures[part.texture] if part.texture >= 0 else -1,
                             "translucency": 0.35 if is_thin else 0.0, "gloss": 0.3 if is_thin else 0.2}])

    def draw_rigid(self, rigid: Rigid, color: Color, **definition: Any) -> None:
        """Draws a rigid body of Frond's; definition: its shape and size, as World.add_rigid had them."""
        from ._lib import make_def

        check(picture_library().frond_picture_draw_rigid(self._picture, make_def("rigid", "R", definition),
                                                         need(rigid, Rigid, "rigid")._handle, color_of(color)))

    def draw_robot(self, robot: Robot, color: Color) -> None:
        """Draws the collision shapes of a robot of Frond's."""
        check(picture_library().frond_picture_draw_robot(self._picture, need(robot, Robot, "robot")._handle,
                                                           color_of(color)))

    def draw_grab(self, grab: Grab) -> None:
        """Draws an arrow from the held point to its target."""
        check(picture_library().frond_picture_draw_grab(self._picture, need(grab, Grab, "grab")._handle))


def platform(name: PicturePlatform | str) -> PicturePlatform:
    """Returns where an OpenGL context comes from, by its name."""
    return PicturePlatform(row_of(name, "frond_picture_platform", "platform"))


__all__ = ["Color", "FARTHEST", "Film", "LARGEST", "Picture", "TOLERANCE", "camera_of_box", "camera_of_matrices",
           "camera_on", "compare", "compare_file", "platform", "read_png", "write_png"]
