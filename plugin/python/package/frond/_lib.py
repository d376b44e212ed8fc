"""The C libraries, and what passes between them and Python: errors, settings, results, arrays, documentation."""

from __future__ import annotations

import functools
import inspect
import os
from enum import IntEnum
from pathlib import Path
from typing import Any, Callable, Iterable, Mapping, TypeVar

import cffi
import numpy as np

from ._generated import CDEF, COMMENTS, ENUMS, RESULTS, Array, Material, Result, Vector

FOLDER = Path(__file__).resolve().parent
LIBRARIES = FOLDER / "lib"
HOST_PATH = str(LIBRARIES / "libfrond_host.so")

ffi = cffi.FFI()
ffi.cdef(CDEF)
lib: Any = ffi.dlopen(str(next(LIBRARIES.glob("libfrond-float64.so*"))), ffi.RTLD_NOW | ffi.RTLD_GLOBAL)
host: Any = ffi.dlopen(HOST_PATH, ffi.RTLD_NOW)


@functools.cache
def picture_library() -> Any:
    """Loads the library that draws, which needs EGL, when the first picture is made."""
    return ffi.dlopen(str(LIBRARIES / "libfrond_picture.so"), ffi.RTLD_NOW)


class Error(RuntimeError):
    """What Frond refuses: `code` is its Result, the text says what was wrong and what to do."""

    code: Result

    def __init__(self, code: int, text: str) -> None:
        super().__init__(text)
        self.code = Result(code)


def check(result: int) -> None:
    if result:
        raise Error(result, ffi.string(lib.frond_last_error()).decode())


def check_host(result: int) -> None:
    if result:
        raise Error(result, ffi.string(host.frond_host_last_error()).decode())


def refuse(text: str) -> Error:
    return Error(Result.BAD_ARGUMENT, text)


def text_of(pointer: Any) -> str:
    return ffi.string(pointer).decode(errors="replace") if pointer else ""


# ---- values that go to C ------------------------------------------------------------------------------------------


def numbers(value: Any, name: str, shape: tuple[int, ...], dtype: Any = np.float64) -> np.ndarray:
    """Returns an array for C of this shape, -1 for any length; refuses others with a text."""
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "buif" or (np.dtype(dtype).kind == "i" and array.dtype.kind == "f"):
            raise TypeError(f"it has elements of type {array.dtype}")
        with np.errstate(over="ignore", invalid="ignore"):
            converted = np.ascontiguousarray(array, dtype=dtype)
        is_float = np.dtype(dtype).kind == "f"
        if (np.isfinite(array) & ~np.isfinite(converted)).any() if is_float else not np.array_equal(converted, array):
            raise ValueError("it has numbers that are too large")
    except (TypeError, ValueError, OverflowError) as error:
        raise refuse(f"{name} is not an array of numbers: {error}") from None
    if converted.ndim != len(shape) or any(want not in (-1, have) for want, have in zip(shape, converted.shape)):
        wanted = " x ".join("n" if size < 0 else str(size) for size in shape)
        raise refuse(f"{name} has the shape {converted.shape}; pass {wanted} numbers")
    return converted


def vector(value: Vector, name: str = "the vector") -> tuple[float, ...]:
    return tuple(numbers(value, name, (3,)).tolist())


def integer(value: Any, name: str) -> int:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise refuse(f"{name} is {value!r}; pass an integer")
    if not -(2**31) <= value < 2**31:
        raise refuse(f"{name} is {value}, which is no 32-bit integer")
    return int(value)


def address_of(value: Any, name: str) -> int:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)) or not 0 <= value < 2**64:
        raise refuse(f"{name} is {value!r}; pass the address of an object")
    return int(value)


def mask_of(value: Any, name: str) -> int:
    """Returns a mask of flags."""
    mask = integer(value, name)
    if mask < 0:
        raise refuse(f"{name} is {mask}; combine members of its enum by |, &")
    return mask


def real(value: Any, name: str) -> float:
    if not isinstance(value, (str, bytes, bool, np.bool_)) and np.ndim(value) == 0:
        try:
            return float(value)
        except (TypeError, ValueError, OverflowError):
            pass
    raise refuse(f"{name} is {value!r}; pass a number")


def flag(value: Any, name: str) -> bool:
    if isinstance(value, (bool, np.bool_)) or (isinstance(value, (int, np.integer)) and value in (0, 1)):
        return bool(value)
    raise refuse(f"{name} is {value!r}; pass True or False")


Kind = TypeVar("Kind")


def need(value: Any, kind: type[Kind], name: str) -> Kind:
    """Returns a value that has to be of a class."""
    if not isinstance(value, kind):
        raise refuse(f"{name} is {value!r}; pass a {kind.__name__}")
    return value


def address(pointer: Any) -> int:
    return int(ffi.cast("uintptr_t", pointer))


def row_of(value: Any, c_type: str, name: str) -> int:
    """Returns the number of an enum's member, which may be given by its name in lower case."""
    members = ENUMS[c_type]
    known = {member.name.lower(): member.value for member in members}
    if isinstance(value, str):
        if value.lower() in known:
            return known[value.lower()]
    elif isinstance(value, members):
        return value.value
    elif not isinstance(value, IntEnum) and integer(value, name) in known.values():
        return integer(value, name)
    raise refuse(f"{name} is {value!r}; pass a {members.__name__} or one of its names, {', '.join(known)}")


def path_of(path: Any, name: str = "path") -> bytes:
    try:
        encoded = os.fsencode(os.fspath(path))
    except TypeError:
        raise refuse(f"{name} is {path!r}; pass a path") from None
    if b"\0" in encoded:
        raise refuse(f"{name} contains a zero byte")
    return encoded


def fill(struct: Any, options: Mapping[str, object], what: str) -> Any:
    """Writes keyword arguments into a def or another struct; refuses names that it does not have."""
    fields = dict(ffi.typeof(struct).fields)
    fields.pop("cookie", None)
    for name, value in options.items():
        if name not in fields:
            raise refuse(f"{what} has no setting {name!r}; it has {', '.join(sorted(fields))}")
        kind = fields[name].type
        c_name = kind.cname
        if c_name in ENUMS and c_name != "frond_effects":
            setattr(struct, name, row_of(value, c_name, name))
        elif kind.kind == "struct":
            target = getattr(struct, name)
            if c_name in ("frond_vec3", "frond_quat", "frond_color"):
                for field, number in zip(dict(kind.fields), numbers(value, name, (len(kind.fields),)).tolist()):
                    setattr(target, field, number)
            else:
                fill(target, as_options(value, name), f"{what}'s {name}")
        elif kind.kind == "primitive":
            put_number(struct, name, c_name, value)
        else:
            raise refuse(f"{what}'s {name} cannot be set from Python")
    return struct


def put_number(struct: Any, name: str, c_name: str, value: Any) -> None:
    try:
        if c_name == "_Bool":
            setattr(struct, name, flag(value, name))
        elif c_name in ("double", "float"):
            setattr(struct, name, real(value, name))
        elif isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
            raise refuse(f"{name} is {value!r}; pass an integer")
        else:
            setattr(struct, name, int(value))
    except OverflowError as error:
        raise refuse(f"{name} is {value!r}: {error}") from None


def as_options(value: Any, name: str) -> Mapping[str, object]:
    """Takes a dict of settings, or a result that has the same fields."""
    if isinstance(value, dict):
        return value
    if type(value) in RESULTS.values():
        return {field: getattr(value, field) for field in type(value).__dataclass_fields__}
    raise refuse(f"{name} is {value!r}; pass a dict of its fields")


def make_def(name: str, kind: str, options: Mapping[str, object]) -> Any:
    """Makes frond_<name>_def with its defaults and these keyword arguments."""
    struct = ffi.new(f"frond_{name}_def *")
    version = [int(part) for part in text_of(lib.frond_version_string()).split(".")]
    lib.frond_fill_def(struct, ord(kind) << 24 | version[0] << 16 | version[1] << 8 | version[2])
    fill(struct[0], options, f"a {name}")
    return struct


# ---- values that come from C --------------------------------------------------------------------------------------

wrap_handle: dict[str, Any] = {}  # by C type: makes an object from a handle and its world


def to_python(value: Any, world: Any = None) -> Any:
    """Turns a struct into the dataclass of its type, vectors into arrays, enums into enums, handles into objects."""
    kind = ffi.typeof(value)
    if kind.kind == "array":
        return np.array(list(value), dtype=np.float64)
    if kind.kind == "pointer":
        return text_of(value) if kind.item.cname == "char" else address(value)
    if kind.kind != "struct":
        return value
    if kind.cname in ("frond_vec3", "frond_quat", "frond_color"):
        return np.array([getattr(value, name) for name, _ in kind.fields])
    if kind.cname in wrap_handle:
        return wrap_handle[kind.cname](value, world) if value.id else None
    result: Any = RESULTS[kind.cname]
    found = {}
    for name, field in kind.fields:
        if name not in result.__dataclass_fields__:
            continue
        c_name, item = field.type.cname, getattr(value, name)
        of_effects = c_name in ("uint32_t", "unsigned int") and name.startswith("effects")
        enum = ENUMS["frond_effects"] if of_effects else ENUMS.get(c_name)
        if enum is not None:
            found[name] = enum(int(ffi.cast("unsigned int", item)) if isinstance(item, ffi.CData) else row(item, enum))
        else:
            found[name] = to_python(item, world) if isinstance(item, ffi.CData) else item
    return result(**found)


def row(item: Any, enum: Any) -> int:
    """Returns the number of an enum's value, which cffi gives by its C name."""
    if isinstance(item, int):
        return item
    return next(member.value for member in enum if item.endswith("_" + member.name))


def view(pointer: Any, dtype: str, shape: tuple[int, ...], owner: Any) -> np.ndarray:
    """Makes a read-only array of memory of C's, which keeps `owner` alive."""
    size = int(np.prod(shape)) * np.dtype(dtype).itemsize
    if not size or not pointer:
        return np.zeros(shape, dtype)
    kept = ffi.gc(pointer, lambda _, owner=owner: None)
    array = np.frombuffer(ffi.buffer(kept, size), dtype).reshape(shape)
    array.flags.writeable = False
    return array


def array_out(count: int, width: int = 3) -> tuple[np.ndarray, Any]:
    """Makes an array that C writes numbers to, and its address."""
    array = np.zeros((count, width) if width else (count,))
    return array, ffi.from_buffer("double[]", array) if array.size else ffi.NULL


# ---- classes ------------------------------------------------------------------------------------------------------

Class = TypeVar("Class", bound=type)


def functions_in(code: Any) -> Iterable[str]:
    return (name for name in code.co_names if name in COMMENTS)


def documented(cls: Class) -> Class:
    """Adds the comments of the C functions that a method calls to its documentation, and holds the world meanwhile."""
    for name, member in list(vars(cls).items()):
        function = member.fget if isinstance(member, property) else member
        if name.startswith("_") and name != "__init__" or not inspect.isfunction(function):
            continue
        texts = [f"{c}: {COMMENTS[c]}" for c in functions_in(function.__code__) if COMMENTS[c]]
        function.__doc__ = "\n\n".join([inspect.cleandoc(function.__doc__ or ""), *texts])
        if name == "__init__":
            continue
        held = holding(function)
        setattr(cls, name, property(held, doc=function.__doc__) if isinstance(member, property) else held)
    return cls


def holding(function: Callable) -> Callable:
    @functools.wraps(function)
    def call(self: Any, *args: Any, **options: Any) -> Any:
        guard = self._world_guard(function)
        if guard is None:
            return function(self, *args, **options)
        with guard:
            return function(self, *args, **options)

    return call


Function = TypeVar("Function", bound=Callable)


def changes_world(function: Function) -> Function:
    """Marks a method that adds to the Bullet world or takes from it: no other thread may step it meanwhile."""
    function._changes_world = True  # type: ignore[attr-defined]
    return function


@functools.singledispatch
def material_struct(material: Any) -> Any:
    raise refuse(f"the material {material!r} is none; pass a Material, a dict of its fields, or the name of a preset")


@material_struct.register
def _(material: str) -> Any:
    struct = ffi.new("frond_material *")
    check(lib.frond_material_preset(material.encode(), struct))
    return struct


@material_struct.register(dict)
@material_struct.register(Material)
def _(material: Any) -> Any:
    struct = ffi.new("frond_material *", lib.frond_default_material())
    fill(struct[0], as_options(material, "the material"), "a material")
    return struct


__all__ = ["Array", "Error"]
