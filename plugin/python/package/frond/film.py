"""Films, and files of pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._generated import PictureDifference, Result
from ._lib import (Error, documented, ffi, fill, integer, numbers, path_of, picture_library, real, refuse, text_of,
                   to_python)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._generated import FilmDefOptions

TOLERANCE = 3.5
"""Tolerance for reference pictures [Delta E]."""


def check(ok: bool) -> None:
    if not ok:
        raise Error(Result.BAD_ARGUMENT, text_of(picture_library().frond_picture_last_error()))


@documented
class Film:
    """Frames of a run, to be written as a moving picture and as a contact sheet."""

    def __init__(self, width: int, height: int, **options: Unpack[FilmDefOptions]) -> None:
        """Begins a film of frames of this size; the other keyword arguments are those of FilmDefOptions."""
        library = picture_library()
        struct = ffi.new("frond_film_def *", library.frond_default_film_def())
        fill(struct[0], {"width": width, "height": height, **options}, "a film")
        out = ffi.new("frond_film **")
        check(library.frond_film_create(struct, out))
        self._film = ffi.gc(out[0], library.frond_film_destroy)
        self._shape = (height, width, 3)

    def _world_guard(self, function: Any) -> None:
        return None

    def destroy(self) -> None:
        """Frees the film now."""
        picture_library().frond_film_destroy(self._film)

    def add(self, pixels: npt.ArrayLike) -> None:
        """Adds a frame, height x width x 3 of bytes, as Picture.pixels."""
        array = numbers(pixels, "pixels", self._shape, np.uint8)
        check(picture_library().frond_film_add(self._film, ffi.from_buffer("uint8_t[]", array)))

    @property
    def frame_count(self) -> int:
        """The number of frames."""
        return picture_library().frond_film_get_frame_count(self._film)

    def write_webp(self, path: Any) -> None:
        """Writes an animated WebP; afterwards nothing can be added."""
        check(picture_library().frond_film_write_webp(self._film, path_of(path)))

    def write_sheet(self, png_path: Any, columns: int, rows: int) -> None:
        """Writes a sheet of at most columns x rows frames."""
        check(picture_library().frond_film_write_sheet(self._film, path_of(png_path), integer(columns, "columns"),
                                                       integer(rows, "rows")))


def rgb_of(pixels: npt.ArrayLike, name: str) -> np.ndarray:
    return numbers(pixels, name, (-1, -1, 3), np.uint8)


def write_png(path: Any, pixels: npt.ArrayLike) -> None:
    """Writes height x width x 3 bytes as a PNG."""
    array = rgb_of(pixels, "pixels")
    check(picture_library().frond_picture_write_png(path_of(path), ffi.from_buffer("uint8_t[]", array), array.shape[1],
                                                    array.shape[0]))


def read_png(path: Any) -> npt.NDArray[np.uint8]:
    """Reads a PNG as height x width x 3 bytes, blended over black."""
    out, width, height = ffi.new("uint8_t **"), ffi.new("int *"), ffi.new("int *")
    check(picture_library().frond_picture_read_png(path_of(path), out, width, height))
    pixels = np.frombuffer(bytes(ffi.buffer(out[0], width[0] * height[0] * 3)), np.uint8)
    picture_library().frond_picture_free(out[0])
    return pixels.reshape(height[0], width[0], 3)


def compare(a: npt.ArrayLike, b: npt.ArrayLike, tolerance: float = TOLERANCE) -> PictureDifference:
    """Compares two pictures as the eye does."""
    first, second = rgb_of(a, "a"), rgb_of(b, "b")
    if first.shape != second.shape:
        raise refuse(f"the pictures are of different size, {first.shape} and {second.shape}")
    out = ffi.new("frond_picture_difference *")
    check(picture_library().frond_picture_compare(
        ffi.from_buffer("uint8_t[]", first), ffi.from_buffer("uint8_t[]", second), first.shape[1], first.shape[0],
        real(tolerance, "tolerance"), out, ffi.NULL))
    return to_python(out[0])


def compare_file(pixels: npt.ArrayLike, reference_png: Any, tolerance: float = TOLERANCE,
                 difference_png: Any = None) -> PictureDifference:
    """Compares a picture with a reference, and writes both and their difference to a PNG where they differ."""
    array, out = rgb_of(pixels, "pixels"), ffi.new("frond_picture_difference *")
    check(picture_library().frond_picture_compare_file(
        ffi.from_buffer("uint8_t[]", array), array.shape[1], array.shape[0], path_of(reference_png),
        real(tolerance, "tolerance"), out, ffi.NULL if difference_png is None else path_of(difference_png)))
    return to_python(out[0])


__all__ = ["Film", "TOLERANCE", "check", "compare", "compare_file", "read_png", "write_png"]
