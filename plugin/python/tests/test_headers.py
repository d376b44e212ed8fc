"""The package has all of the headers: functions, settings, fields, choices; and types and documentation."""

import ast
import inspect
import re
import subprocess
import sys
from pathlib import Path

import frond
import frond.picture
import pytest
from frond import _generated as generated
from frond._lib import ffi, host, lib, picture_library

PACKAGE = Path(frond.__file__).parent
# Of the headers for C++, and what stands for them here.
CPP = {"attach": "frond_host_attach", "forget": "frond_host_is_alive", "bullet_world": "frond_host_get_world",
       "bullet_object": "frond_host_get_object", "bond": "frond_host_bond", "plant_of": "frond_host_get_plant",
       "multi_body": "frond_host_get_multi_body", "joint_motor": "frond_host_get_motor"}


def names_used():
    used = set()
    for path in PACKAGE.glob("*.py"):
        if path.name != "_generated.py":
            used |= {node.attr for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Attribute)}
    return used


def functions_declared():
    declared = re.findall(r"\b(frond_\w+)\s*\(", generated.CDEF)
    return {name for name in declared if not name.endswith("_fn")}


def test_every_function_of_the_headers_is_used():
    declared = functions_declared()
    assert len(declared) > 150
    assert declared - names_used() == set()


def test_every_function_is_in_its_library():
    for name in functions_declared():
        found = picture_library() if re.match("frond_(picture|film|default_picture|default_film)", name) else \
            host if name.startswith("frond_host") else lib
        assert getattr(found, name)


def test_every_function_for_cpp_has_one_here():
    include = Path(__file__).resolve().parents[2] / "include" / "frond"
    for header in ("frond_bullet.hpp", "frond_robot.hpp"):
        for name in re.findall(r"FROND_API [\w:* ]*?[ *](\w+)\(", (include / header).read_text()):
            assert CPP[name] in names_used(), name


def test_settings_and_results_are_those_of_the_headers():
    assert "cookie" not in frond.PlantDef.__dataclass_fields__
    for name, result in generated.RESULTS.items():
        fields = {field for field, _ in ffi.typeof(name).fields} - {"cookie", "organs"}
        assert fields == set(result.__dataclass_fields__), name
    for name in ("world", "wind", "model", "plant", "detail", "rigid", "robot"):
        options = getattr(generated, f"{name.capitalize()}DefOptions").__annotations__
        # Pointers are data and functions of the host's, but for corrections of organs; add_plant and others have
        # parameters for what is of use.
        fields = {field for field, kind in ffi.typeof(f"frond_{name}_def").fields
                  if (kind.type.kind not in ("pointer", "function") or field.startswith("corrections"))
                  and field not in ("cookie", "organ_count", "correction_count")}
        assert fields == set(options), name


def test_choices_have_the_names_of_the_library():
    for enum in (frond.Mechanics, frond.Integrator, frond.Response, frond.Detail, frond.Event, frond.Shape,
                 frond.LinearSolver, frond.Mass, frond.HashLayout, frond.Joint, frond.Effect):
        for member in enum:
            assert frond.name_of(member) == member.name.lower()
    assert frond.name_of(frond.Result.BAD_HANDLE).startswith("the handle is null")
    assert frond.Effect.DEFAULT & frond.Effect.WIND and not frond.Effect.DEFAULT & frond.Effect.BREAKING


@pytest.mark.parametrize("cls", [frond.World, frond.Model, frond.Plant, frond.Grab, frond.Bond, frond.Rigid,
                                 frond.Robot, frond.picture.Picture, frond.picture.Film])
def test_all_is_documented(cls):
    for name, member in inspect.getmembers(cls):
        if not name.startswith("_") and (callable(member) or isinstance(member, property)):
            assert member.__doc__ and len(member.__doc__) > 10, f"{cls.__name__}.{name}"
    assert "frond_plant_get_root_force: Computes the force that holds a plant" in frond.Plant.root_force.__doc__
    assert "[Pa]" in generated.MaterialOptions.__doc__


def test_the_package_s_own_types_agree(tmp_path):
    command = [sys.executable, "-m", "mypy", "--ignore-missing-imports", "-p", "frond", "--exclude", "examples"]
    run = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert run.returncode == 0, run.stdout + run.stderr


def test_types_are_right(tmp_path):
    assert (PACKAGE / "py.typed").exists()
    program = tmp_path / "typed.py"
    program.write_text("import frond\n"
                       "world = frond.World(gravity=(0, 0, -9.81), sleep_distance=0)\n"
                       "plant = world.add_plant(frond.Model('corn', scale=1.0), mechanics='rod')\n"
                       "reveal_type(plant.tip)\n"
                       "reveal_type(world.report.awake_count)\n"
                       "world.add_plant(frond.Model('corn'), no_such_setting=1)\n")
    run = subprocess.run([sys.executable, "-m", "mypy", "--ignore-missing-imports", str(program)], capture_output=True,
                         text=True)
    assert 'Revealed type is "int"' in run.stdout or '"builtins.int"' in run.stdout, run.stdout + run.stderr
    assert "ndarray" in run.stdout and run.stdout.count("error:") == 1 and "no_such_setting" in run.stdout
