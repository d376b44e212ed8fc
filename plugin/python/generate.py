"""Writes frond/_generated.py from Frond's C headers: declarations for cffi, enums, types of settings and results, and
the headers' own comments.

    generate.py OUTPUT INCLUDE_FOLDER ...    the headers are looked for in the folders
"""

import keyword
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HEADERS = ["frond/frond.h", "frond/frond_robot.h", "frond/frond_snapshot.h", "frond_picture.h", "frond_host.h"]
# Enums without a name, by the prefix of their members.
FLAGS = {"FROND_EFFECT_": "Effect", "FROND_TROUBLE_": "Trouble", "FROND_PICTURE_": "PictureWhat"}
# Structs that the package has classes of its own for.
OWN = {"frond_vec3", "frond_quat", "frond_color", "frond_world", "frond_model", "frond_plant", "frond_grab",
       "frond_rigid", "frond_bond", "frond_robot", "frond_picture_mesh", "frond_force"}
TYPES = {"double": "float", "float": "float", "int": "int", "uint32_t": "int", "uint64_t": "int", "size_t": "int",
         "bool": "bool", "frond_vec3": "Array", "frond_quat": "Array", "frond_color": "Array",
         "const char*": "str", "frond_effects": "Effect", "frond_plant": "Plant | None", "frond_rigid": "Rigid",
         "frond_range": "Range"}
# Fields that are parameters of their own.
SEPARATE = {"frond_model_def": ("organs", "organ_count", "correction_count"),
            "frond_organ_correction": ("organ",), "frond_picture_def": ("width", "height"),
            "frond_film_def": ("width", "height")}
GIVEN = {"const frond_organ_correction*": "Mapping[str, OrganCorrectionOptions]", "frond_vec3": "Vector", "frond_quat": "Vector", "frond_color": "Vector", "frond_effects": "Effect | int",
         "frond_picture_camera": "PictureCameraOptions | PictureCamera"}


def camel(name):
    return "".join(part.capitalize() for part in name.removeprefix("frond_").split("_"))


def preprocessed(folders):
    """Returns the declarations of all headers, without comments and what they include."""
    with tempfile.TemporaryDirectory() as stubs:
        for name in ("stdbool.h", "stddef.h", "stdint.h"):
            Path(stubs, name).touch()
        source = "".join(f'#include "{header}"\n' for header in HEADERS)
        places = [f"-I{folder}" for folder in (stubs, *folders)]
        command = ["cc", "-E", "-P", "-xc", "-nostdinc", "-DFROND_API=", *places, "-"]
        text = subprocess.run(command, input=source, capture_output=True, text=True, check=True).stdout
    return re.sub(r"static inline [^{;]*\{.*?\n\}", "", text, flags=re.S)


def evaluate_enums(text):
    """Replaces enums' expressions by numbers. Returns the text, and the members of each enum in their order."""
    enums, known = [], {}

    def replace(match):
        members, value = {}, -1
        for item in filter(None, (item.strip() for item in match["body"].split(","))):
            name, _, expression = (part.strip() for part in item.partition("="))
            value = eval(expression, {}, known) if expression else value + 1
            members[name] = known[name] = value
        enums.append((match["name"], members))
        body = ", ".join(f"{name} = {value}" for name, value in members.items())
        return f"enum {match['tag'] or ''} {{ {body} }}"

    text = re.sub(r"enum\s*(?P<tag>\w+)?\s*\{(?P<body>[^}]*)\}(?=\s*(?P<name>\w+)?)", replace, text)
    return text, enums


def comment_text(comment):
    if comment.strip().startswith("----"):
        return ""
    lines = (re.sub(r"^\s*\*? ?", "", line).rstrip() for line in comment.strip().splitlines())
    return "\n".join(lines).replace("\\", "").strip()


def comments_of(folders):
    """Returns the comments of functions and structs by their names, and the text of each struct with its comments."""
    functions, structs = {}, {}
    for header in HEADERS:
        path = next(Path(folder, header) for folder in folders if Path(folder, header).exists())
        text = path.read_text()
        for part in ([path.parent / name for name in ("frond_types.h", "frond_core.h", "frond_expert.h")]
                     if path.name == "frond.h" else []):
            text += part.read_text()
        comment = r"(?:/\*(?P<comment>(?:[^*]|\*(?!/))*)\*/\s*)"
        for match in re.finditer(comment + r"(?:static inline |FROND_API )?[\w* ]*?\b(?P<name>frond_\w+)\(", text):
            functions.setdefault(match["name"], comment_text(match["comment"]))
        for match in re.finditer(comment + r"?typedef struct \w+ \{\n(?P<body>.*?)\n\} (?P<name>\w+);", text, re.S):
            lines = [line[4:] if line.startswith("    ") else line for line in match["body"].splitlines()
                     if "cookie" not in line]
            structs[match["name"]] = (comment_text(match["comment"] or ""), "\n".join(lines))
    return functions, structs


def fields_of(text):
    """Returns each struct's fields: name, C type, length or 0."""
    structs = {}
    for match in re.finditer(r"typedef struct (\w+) \{(.*?)\} \1;", text, re.S):
        fields = []
        for declaration in filter(None, (part.strip() for part in match[2].split(";"))):
            declaration = re.sub(r"\s*\*\s*", "* ", declaration)
            kind, names = re.match(r"((?:const )?\w+\*?\s+)(.*)", declaration).groups()
            for name in names.split(","):
                name, _, count = name.strip().partition("[")
                fields.append((name, kind.strip(), count.rstrip("]")))
        structs[match[1]] = fields
    return structs


def docstring(name, structs):
    comment, body = structs[name]
    text = (comment + "\n\n" if comment else "") + "::\n\n" + "\n".join("    " + line for line in body.splitlines())
    return '    """' + text.replace('"""', "'''").replace("\n", "\n    ").replace("    \n", "\n") + '\n    """\n'


def write_enums(enums):
    names, out = {}, []
    for name, members in enums:
        members = {m: v for m, v in members.items() if m != "FROND_OK" and not m.endswith("_COUNT")}
        first = next(iter(members))
        prefix = name.upper() + "_" if name else next(p for p in FLAGS if first.startswith(p))
        title = camel(name) if name else FLAGS[prefix]
        names[name] = title
        out.append(f"class {title}({'IntEnum' if name else 'IntFlag'}):")
        out += [f"    {member.removeprefix(prefix)} = {value}" for member, value in members.items()]
        out.append("\n")
    return names, out


def write_structs(structs, comments, enums):
    out, results = [], []
    for name, fields in structs.items():
        if name in OWN or name.endswith("_view") or len(fields) == 1 and fields[0][0] == "id":
            continue
        is_def = name.endswith("_def") or name in ("frond_picture_scene",)
        is_given = is_def or name in ("frond_material", "frond_tuning", "frond_contact_tuning", "frond_rigid_state",
                                      "frond_picture_camera", "frond_stem", "frond_stem_section",
                                      "frond_organ_correction")
        if is_given:
            out += [f"class {camel(name)}Options(TypedDict, total=False):", docstring(name, comments)]
            for field, kind, count in fields:
                if field in SEPARATE.get(name, ()) or kind == "void*" or kind.endswith("_fn*") or field == "cookie":
                    continue
                title = GIVEN.get(kind) or enums.get(kind) and f"{enums[kind]} | str" or TYPES.get(kind)
                out.append(f"    {field}: {title or camel(kind) + 'Options'}")
            out.append("\n")
        if not is_def or name == "frond_plant_def":
            results.append(name)
            out += ["@dataclass(frozen=True)", f"class {camel(name)}:", docstring(name, comments)]
            for field, kind, count in fields:
                if field == "cookie" or kind == "const frond_organ_material*":
                    continue
                title = "int" if kind in ("const void*", "void*") else TYPES.get(kind) or enums.get(kind) or camel(kind)
                out.append(f"    {field}: {'Array' if count else title}")
            out.append("\n")
    return results, out


def main():
    output, folders = sys.argv[1], sys.argv[2:]
    text, enums = evaluate_enums(preprocessed(folders))
    functions, comments = comments_of(folders)
    structs = fields_of(text)
    names, enum_lines = write_enums(enums)
    results, struct_lines = write_structs(structs, comments, names)
    lines = ['"""Written by generate.py from the C headers; do not edit."""', "# fmt: off",
             "from __future__ import annotations", "",
             "from collections.abc import Mapping, Sequence", "from dataclasses import dataclass",
             "from enum import IntEnum, IntFlag",
             "from typing import TYPE_CHECKING, NamedTuple, TypedDict, Union", "",
             "import numpy as np", "import numpy.typing as npt", "",
             "if TYPE_CHECKING:", "    from .plant import Plant", "    from .rigid import Rigid", "",
             "Array = npt.NDArray[np.float64]", "Vector = Union[Sequence[float], npt.NDArray[np.floating]]", "", "",
             *enum_lines, *struct_lines,
             f"ENUMS = {{{', '.join(f'{n!r}: {t}' for n, t in names.items() if n)}, 'frond_effects': Effect}}",
             f"RESULTS = {{{', '.join(f'{n!r}: {camel(n)}' for n in results)}}}",
             f"COMMENTS = {functions!r}", f'CDEF = r"""{text}"""', ""]
    assert not any(keyword.iskeyword(field[0]) for fields in structs.values() for field in fields)
    Path(output).write_text("\n".join(lines))


main()
