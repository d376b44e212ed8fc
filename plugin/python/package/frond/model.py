"""Models: the shape and material of a plant, read-only, shared by many plants."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, NamedTuple, Sequence

import numpy as np
import numpy.typing as npt

from ._generated import Advice, Material, ModelInfo, Organ, Part
from ._lib import (FOLDER, as_options, check, documented, ffi, fill, lib, make_def, material_struct, numbers, path_of, real,
                   refuse, text_of, to_python, view)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._generated import ModelDefOptions, StemOptions, StemSectionOptions

MODELS = FOLDER / "models"


class Cage(NamedTuple):
    """The tets around a plant, at rest."""

    nodes: npt.NDArray[np.float64]
    """node_count x 3 [m]"""
    tets: npt.NDArray[np.int32]
    """tet_count x 4, indices of nodes, positive volume"""


class Chain(NamedTuple):
    """The capsules of a plant, at rest; a node with a parent is the end of a capsule."""

    nodes: npt.NDArray[np.float64]
    """node_count x 3 [m]"""
    radii: npt.NDArray[np.float64]
    """node_count [m]"""
    parents: npt.NDArray[np.int32]
    """node_count; -1 at a root"""


class Texture(NamedTuple):
    """A texture of a surface: the bytes of an image file."""

    name: str
    bytes: bytes


def find_model(path: Any) -> Path:
    """Finds a file of a model: as it is, or by the name of one that the package brings: "corn", "wheat" ..."""
    if isinstance(path, str) and not Path(path).exists():
        for found in (MODELS / path / f"{path}.obj", MODELS / "urdf" / f"{path}.urdf", MODELS / "arm" / f"{path}.urdf"):
            if found.exists():
                return found
    return path


STALE = 2 << 56  # the handle of a model that does not exist


class _Lease:
    """Holds a model of the library's as long as the Model, or an array of it, exists."""

    def __init__(self, identity: int) -> None:
        self.handle = ffi.new("frond_model *", [identity])

    def __del__(self) -> None:
        lib.frond_model_destroy(self.handle[0])


@documented
class Model:
    """The shape and material of a plant. It lives as long as something refers to it; its plants keep what they need.

    Model("corn")                      a plant that the package brings: corn, cucumber, sunflower, wheat, sapling
    Model("plant.obj", scale=0.01)     a file: .obj .ply .glb .gltf .fbx .dae .stl .msh .vtk .urdf
    Model("plant.frond")               one that save or "frond cook" wrote, in milliseconds
    """

    def __init__(self, path: Any, organs: Mapping[str, Material | dict | str] | None = None,
                 **options: Unpack[ModelDefOptions]) -> None:
        """Loads a file. organs: materials by an organ's name or kind, "stem", "blade" ...; the other keyword
        arguments are those of ModelDefOptions."""
        definition, kept = self._def(organs, options)
        name = path_of(find_model(path))
        self._take(lambda out: lib.frond_model_load(name, definition, out), kept)

    @classmethod
    def from_triangles(cls, vertices: npt.ArrayLike, triangles: npt.ArrayLike,
                       organs: Mapping[str, Material | dict | str] | None = None,
                       **options: Unpack[ModelDefOptions]) -> Model:
        """Makes a model from triangles, which may be a soup. vertices: n x 3 [m]; triangles: m x 3, indices."""
        xyz = numbers(vertices, "vertices", (-1, 3), np.float32)
        corners = numbers(triangles, "triangles", (-1, 3), np.int32)
        return cls._made(organs, options, lambda definition, out: lib.frond_model_from_triangles(
            ffi.from_buffer("float[]", xyz), len(xyz), ffi.from_buffer("int32_t[]", corners), len(corners), definition,
            out))

    @classmethod
    def from_stems(cls, stems: Sequence[StemOptions], organs: Mapping[str, Material | dict | str] | None = None,
                   sections: Sequence[StemSectionOptions] | None = None, **options: Unpack[ModelDefOptions]) -> Model:
        """Makes a model from tapered segments: dicts of parent, begin, end [m], radius_begin, radius_end [m]; and of
        their sections, if they have their own."""
        if not isinstance(stems, (list, tuple)):
            raise refuse(f"stems is {stems!r}; pass a list of dicts of parent, begin, end, radius_begin, radius_end")
        array = ffi.new("frond_stem[]", max(len(stems), 1))
        for i, stem in enumerate(stems):
            if not isinstance(stem, dict) or set(stem) != {"parent", "begin", "end", "radius_begin", "radius_end"}:
                raise refuse(f"stem {i} is {stem!r}; pass a dict of parent, begin, end, radius_begin, radius_end")
            fill(array[i], stem, "a stem")
        if sections is None:
            return cls._made(organs, options, lambda definition, out: lib.frond_model_from_stems(
                array, len(stems), definition, out))
        if not isinstance(sections, (list, tuple)) or len(sections) != len(stems):
            raise refuse(f"sections is {sections!r}; pass as many dicts of StemSectionOptions as there are stems")
        own = ffi.new("frond_stem_section[]", max(len(stems), 1))
        for i, section in enumerate(sections):
            fill(own[i], as_options(section, f"section {i}"), "a stem's section")
        return cls._made(organs, options, lambda definition, out: lib.frond_model_from_stem_sections(
            array, own, len(stems), definition, out))

    @classmethod
    def from_tets(cls, nodes: npt.ArrayLike, tets: npt.ArrayLike,
                  organs: Mapping[str, Material | dict | str] | None = None,
                  **options: Unpack[ModelDefOptions]) -> Model:
        """Makes a model from tets, simulated as they are. nodes: n x 3 [m]; tets: m x 4, indices."""
        xyz = numbers(nodes, "nodes", (-1, 3))
        corners = numbers(tets, "tets", (-1, 4), np.int32)
        return cls._made(organs, options, lambda definition, out: lib.frond_model_from_tets(
            ffi.from_buffer("double[]", xyz), len(xyz), ffi.from_buffer("int32_t[]", corners), len(corners), definition,
            out))

    @classmethod
    def _made(cls, organs: Any, options: Any, make: Any) -> Model:
        model = cls.__new__(cls)
        definition, kept = cls._def(organs, options)
        model._take(lambda out: make(definition, out), kept)
        return model

    @staticmethod
    def _def(organs: Any, options: Any) -> tuple[Any, Any]:
        options = dict(options)
        corrections, file = options.pop("corrections", None), options.pop("corrections_file", None)
        definition = make_def("model", "M", options)
        if organs is not None and not isinstance(organs, Mapping):
            raise refuse(f"organs is {organs!r}; pass a dict of materials by the name or kind of an organ")
        kept = []
        materials = ffi.new("frond_organ_material[]", max(len(organs or ()), 1))
        for i, (organ, material) in enumerate((organs or {}).items()):
            kept.append(ffi.new("char[]", str(organ).encode()))
            materials[i].organ = kept[-1]
            materials[i].material = material_struct(material)[0]
        definition.organs, definition.organ_count = materials, len(kept)
        if corrections is not None and not isinstance(corrections, Mapping):
            raise refuse(f"corrections is {corrections!r}; pass a dict of OrganCorrectionOptions by an organ's name")
        rows = ffi.new("frond_organ_correction[]", max(len(corrections or ()), 1))
        for row, (organ, correction) in zip(rows, (corrections or {}).items()):
            fields = {"organ": organ, **as_options(correction, f"the correction of {organ!r}")}
            for name in {"organ", "kind", "parent"} & fields.keys():
                kept.append(ffi.new("char[]", str(fields.pop(name)).encode()))
                setattr(row, name, kept[-1])
            fill(row, fields, "a correction")
        definition.corrections, definition.correction_count = rows, len(corrections or ())
        if file is not None:
            kept.append(ffi.new("char[]", path_of(file, "corrections_file")))
            definition.corrections_file = kept[-1]
        return definition, (kept, materials, rows)

    def _take(self, make: Any, kept: Any) -> None:
        out = ffi.new("frond_model *")
        check(make(out))
        self._lease: _Lease | None = _Lease(out.id)
        self._handle = ffi.new("frond_model *", out[0])[0]

    def _world_guard(self, function: Any) -> None:
        return None

    def __enter__(self) -> Model:
        return self

    def __exit__(self, *_: Any) -> None:
        self.destroy()

    def destroy(self) -> None:
        """Makes the handle stale. The memory is freed when arrays of it and plants have gone too."""
        self._handle.id = STALE
        self._lease = None

    @property
    def is_valid(self) -> bool:
        """Whether it was not destroyed."""
        return lib.frond_model_is_valid(self._handle)

    @property
    def info(self) -> ModelInfo:
        """Sizes, counts and quality."""
        out = ffi.new("frond_model_info *")
        check(lib.frond_model_get_info(self._handle, out))
        return to_python(out[0])

    @property
    def parts(self) -> list[Part]:
        """Runs of triangles of the surface, of one appearance each."""
        return [self._row(lib.frond_model_get_part, "frond_part", i) for i in range(self.info.part_count)]

    @property
    def organs(self) -> list[Organ]:
        """Stems, leaves, fruits, with their materials and sections."""
        return [self._row(lib.frond_model_get_organ, "frond_organ", i) for i in range(self.info.organ_count)]

    def _row(self, get: Any, kind: str, index: int) -> Any:
        out = ffi.new(f"{kind} *")
        check(get(self._handle, index, out))
        return to_python(out[0])

    @property
    def textures(self) -> list[Texture]:
        """The images on the surface."""
        found = []
        for i in range(self.info.texture_count):
            out = ffi.new("frond_texture_view *")
            check(lib.frond_model_get_texture(self._handle, i, out))
            found.append(Texture(text_of(out.name), bytes(ffi.buffer(out.bytes, out.byte_count)) if out.bytes else b""))
        return found

    @property
    def cage(self) -> Cage:
        """The tets around the plant at rest; read-only arrays that keep the model alive."""
        out = ffi.new("frond_cage_view *")
        check(lib.frond_model_get_cage(self._handle, out))
        return Cage(view(out.nodes, "f8", (out.node_count, 3), self._lease),
                    view(out.tets, "i4", (out.tet_count, 4), self._lease))

    @property
    def chain(self) -> Chain:
        """The capsules of the plant at rest; read-only arrays that keep the model alive."""
        out = ffi.new("frond_chain_view *")
        check(lib.frond_model_get_chain(self._handle, out))
        return Chain(view(out.nodes, "f8", (out.node_count, 3), self._lease),
                     view(out.radii, "f8", (out.node_count,), self._lease),
                     view(out.parents, "i4", (out.node_count,), self._lease))

    @property
    def capsule_organs(self) -> npt.NDArray[np.int32]:
        """The organ of each capsule, an index in organs; -1: of none."""
        array = np.zeros(self.info.capsule_count, np.int32)
        out = ffi.from_buffer("int32_t[]", array) if array.size else ffi.NULL
        check(lib.frond_model_get_capsule_organs(self._handle, out, array.size))
        return array

    def save(self, path: Any) -> None:
        """Saves the model with all that was built for it; Model(path) then has it in milliseconds."""
        check(lib.frond_model_save(self._handle, path_of(path)))

    def to_bytes(self) -> bytes:
        """Returns what save writes."""
        size = lib.frond_model_get_saved_size(self._handle)
        out = ffi.new("uint8_t[]", max(size, 1))
        check(lib.frond_model_save_bytes(self._handle, out, size))
        return bytes(ffi.buffer(out, size))

    @classmethod
    def from_bytes(cls, cooked: bytes) -> Model:
        """Makes a model from the bytes of to_bytes, or of a file that save or "frond cook" wrote."""
        if not isinstance(cooked, (bytes, bytearray, memoryview)):
            raise refuse(f"cooked is {type(cooked).__name__}; pass the bytes of to_bytes")
        data = bytes(cooked)
        model = cls.__new__(cls)
        model._take(lambda out: lib.frond_model_load_bytes(data, len(data), out), data)
        return model

    def write_urdf(self, path: Any) -> None:
        """Writes the chain as a URDF file."""
        check(lib.frond_model_write_urdf(self._handle, path_of(path)))

    def recommend(self, error: float = 0, cpu: float = 0) -> Advice:
        """Recommends settings: the cheapest of this error [-], or the most accurate of this cost [s per s]."""
        out = ffi.new("frond_advice *")
        check(lib.frond_recommend(self._handle, real(error, "error"), real(cpu, "cpu"), out))
        return to_python(out[0])


def default_material() -> Material:
    """Returns the material of an organ of unknown kind, a stem's."""
    return to_python(lib.frond_default_material())


def material_preset(kind: str) -> Material:
    """Looks up published values for "stem", "blade" ...; an unknown kind's text names those there are."""
    return to_python(material_struct(str(kind))[0])


__all__ = ["Cage", "Chain", "MODELS", "Model", "Texture", "default_material", "find_model", "material_preset"]
