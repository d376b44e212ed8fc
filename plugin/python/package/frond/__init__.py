"""Frond: plants that bend, for worlds simulated by the Bullet physics engine.

    import frond

    world = frond.World()
    plant = world.add_plant(frond.Model("corn"))
    for _ in range(120):
        world.step(1 / 60)
    print(plant.tip)

frond.pybullet puts plants into the world of PyBullet, frond.picture draws them. SI units throughout; rotations are
x, y, z, w. Everything that is refused raises frond.Error, whose text says what to do. Settings are keyword arguments,
named and documented as in the C headers; a choice is a member of its enum or its name, "rod". The objects of one world
are to be used by one thread at a time.
"""

from __future__ import annotations

from typing import Any, Callable

from ._generated import *  # noqa: F403
from ._generated import ENUMS, RESULTS
from ._lib import Error, ffi, lib, refuse, text_of
from .model import (MODELS, Cage, Chain, Model, Texture, default_material, find_model, material_preset)
from .hold import Bond, Grab
from .plant import Plant, Surface, plant_at
from .rigid import Rigid
from .robot import Robot
from .thing import Wrench
from .world import AS_MOTION_STATES, FORCE_TYPE, World

__version__ = text_of(lib.frond_version_string())

_log: Any = None


def set_log(log: Callable[[str], None] | None) -> None:
    """Sets where warnings go, log(text); None silences them. By default they are written to stderr."""
    global _log
    if log is not None and not callable(log):
        raise refuse(f"log is {log!r}; pass a function or None")

    def call(message: Any, _: Any) -> None:
        try:
            log(text_of(message))  # type: ignore[misc]
        except Exception as error:  # cannot pass through C
            import warnings

            warnings.warn(f"the function given to frond.set_log raised {error!r}", stacklevel=2)

    function = ffi.NULL if log is None else ffi.callback("frond_log_fn", call)
    lib.frond_set_log(function, ffi.NULL)
    _log = function


def name_of(choice: Any) -> str:
    """Returns the library's short name of a member of an enum, "rod"."""
    names = {"Effect": lib.frond_effect_name, "Mechanics": lib.frond_mechanics_name,
             "Integrator": lib.frond_integrator_name, "Response": lib.frond_response_name,
             "Detail": lib.frond_detail_name, "Event": lib.frond_event_name, "Shape": lib.frond_shape_name,
             "LinearSolver": lib.frond_linear_solver_name, "Mass": lib.frond_mass_name, "Collision": lib.frond_collision_name,
             "HashLayout": lib.frond_hash_layout_name, "Joint": lib.frond_joint_name, "Result": lib.frond_result_name}
    if type(choice) not in ENUMS.values() or type(choice).__name__ not in names:
        raise refuse(f"choice is {choice!r}; pass a member of an enum of Frond's: {', '.join(names)}")
    return text_of(names[type(choice).__name__](choice.value))


__all__ = ["AS_MOTION_STATES", "Bond", "Cage", "Chain", "Error", "FORCE_TYPE", "Grab", "MODELS", "Model", "Plant",
           "Rigid", "Robot", "Surface", "Texture", "World", "Wrench", "default_material", "find_model",
           "material_preset", "name_of", "plant_at", "set_log",
           *(enum.__name__ for enum in ENUMS.values()), *(result.__name__ for result in RESULTS.values())]
