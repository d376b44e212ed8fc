"""Every public function with wrong arguments of every kind, and with stale handles: an error that names the remedy, or
no change; never another exception, never a crash."""

import faulthandler
import inspect
import math

import frond
import frond.picture
import frond.pybullet
import numpy as np
import pybullet as p
import pytest

WRONG = [None, math.nan, math.inf, "text", "", "a\0b", b"bytes", [], [1.0], (1, 2), [[1, 2], [3, 4]], -1, 2**31, 2**70,
         1e300, -1e-3, 0, True, {}, {"a": 1}, object(), print, np.zeros((2, 2)), np.full(3, np.nan),
         np.zeros(3, complex), [None] * 3, ["a", "b", "c"]]
STEMS = [{"parent": -1, "begin": (0, 0, 0), "end": (0, 0.5, 0), "radius_begin": 0.02, "radius_end": 0.015}]
# Values that are right, by the names of parameters.
RIGHT = {"point": (0, 0.3, 0), "position": (0.1, 0.2, 0.3), "rotation": (0, 0, 0, 1), "target": (0, 0.6, 0),
         "stiffness": 10.0, "node": 0, "capsule": 0, "force": (0, 0, 0), "link": 0, "velocity": 0.1, "dt": 0.01,
         "origin": (0, 0, 0), "direction": (1, 0, 0), "max_distance": 1.0, "fraction": 1.0, "effects": frond.Effect.ALL,
         "mechanics": "rod", "integrator": "bdf2", "gravity": (0, -9.81, 0), "body": 0, "view": np.eye(4).ravel(),
         "projection": p.computeProjectionMatrixFOV(40, 1, 0.1, 30), "vertices": np.eye(3), "triangles": [[0, 1, 2]],
         "nodes": np.eye(4)[:, :3], "tets": [[0, 1, 2, 3]], "stems": STEMS, "lower": (0, 0, 0), "upper": (1, 1, 1),
         "width": 16, "height": 16, "center": (0, 0, 0), "radius": 0.1, "color": (1, 0, 0), "begin": (0, 0, 0),
         "end": (0, 1, 0), "half_extents": (1, 1, 1), "size": 2.0, "positions": np.eye(3), "number": 1, "image": b"",
         "kind": "stem", "snapshot": b"", "name": "stem", "path": "/no/such/file", "error": 0.1, "framebuffer": 0}


class Scene:
    """One of each kind of thing, all alive, or all stale."""

    def __init__(self, folder):
        self.folder = folder
        self.model = frond.Model.from_stems(STEMS)
        self.world = frond.World()
        self.client = p.connect(p.DIRECT)
        self.bullet = frond.pybullet.attach(self.client)
        self.plant = self.world.add_plant(self.model)
        self.rigid = self.world.add_rigid(mass=0, position=(0, 3, 0))
        self.robot = self.world.add_robot("arm", position=(2, 0, 0))
        self.picture = frond.picture.Picture(16, 16, samples=1)
        self.film = frond.picture.Film(16, 16)
        self.things = [self.world, self.bullet, self.plant, self.bullet.add_plant(self.model), self.rigid, self.robot,
                       self.plant.grab((0, 0.5, 0), 5), self.plant.bond((0, 0.3, 0), self.rigid), self.model,
                       self.picture, self.film, frond.pybullet.Drawing(self.bullet)]

    def spoil(self):
        """Makes all of them stale: PyBullet's by a reset, the others by hand."""
        p.resetSimulation(physicsClientId=self.client)
        for thing in (self.world, self.picture, self.film, self.model):
            thing.destroy()

    def end(self):
        if p.isConnected(self.client):
            p.disconnect(self.client)

    def right(self, name):
        things = {"plant": self.plant, "rigid": self.rigid, "robot": self.robot, "model": self.model,
                  "world": self.bullet, "client": self.client, "grab": self.things[6], "path": self.folder / "file",
                  "png_path": self.folder / "a.png", "pixels": np.zeros((16, 16, 3), np.uint8),
                  "file": self.folder / "b"}
        return things.get(name, RIGHT.get(name))


def reading(thing, name):
    return lambda: getattr(thing, name)


def functions_of(scene):
    """Returns all public methods of the things, and the modules' functions, with a name for each."""
    found = []
    for thing in scene.things:
        for name, member in inspect.getmembers(type(thing)):
            if name.startswith("_") or name in ("destroy", "frame"):
                continue
            if isinstance(member, property):
                found.append((f"{type(thing).__name__}.{name}", reading(thing, name)))
            elif callable(member):
                found.append((f"{type(thing).__name__}.{name}", getattr(thing, name)))
    for module in (frond, frond.picture, frond.pybullet):
        for name in module.__all__:
            member = getattr(module, name)
            if callable(member) and not (inspect.isclass(member) and issubclass(member, (Exception, tuple, int))) and \
                    not hasattr(member, "__dataclass_fields__") and name not in ("Color", "detach", "set_log"):
                found.append((f"{module.__name__}.{name}", member))
    return found


def try_call(name, function, arguments, options, faults):
    try:
        function(*arguments, **options)
    except frond.Error as error:
        if len(str(error)) <= 12:
            faults.append(f"{name}{arguments}{options}: the text is only {error}")
    except Exception as error:
        faults.append(f"{name}{arguments}{options}: {type(error).__name__} {error}")


def parameters_of(function):
    kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return [one for one in inspect.signature(function).parameters.values() if one.kind in kinds]


def options_of(function):
    """Returns the names of the settings that a function takes as keyword arguments."""
    kept = [one for one in inspect.signature(function).parameters.values() if one.kind == one.VAR_KEYWORD]
    kind = str(kept[0].annotation).removeprefix("Unpack[").removesuffix("]") if kept else ""
    types = [getattr(frond._generated, part, None) for part in
             ("RigidDefOptions", "RigidStateOptions") if kind == "RigidOptions"] or \
        [getattr(frond._generated, kind, None)]
    return [name for one in types if one for name in one.__annotations__]


@pytest.fixture(params=["alive", "stale"])
def scene(request, tmp_path, monkeypatch):
    faulthandler.enable()
    monkeypatch.chdir(tmp_path)  # some wrong arguments are names of files
    made = Scene(tmp_path)
    if request.param == "stale":
        made.spoil()
    yield made
    made.end()


def test_wrong_arguments_are_refused(scene):
    faults, calls = [], 0
    for name, function in functions_of(scene):
        parameters = parameters_of(function)
        needed = [one for one in parameters if one.default is one.empty]
        right = [scene.right(one.name) for one in needed]
        try_call(name, function, right, {}, faults)
        for i, parameter in enumerate(parameters):
            for wrong in WRONG:
                arguments, options = list(right), {}
                if i < len(needed):
                    arguments[i] = wrong
                else:
                    options[parameter.name] = wrong
                try_call(name, function, arguments, options, faults)
                calls += 1
        for option in options_of(function):
            for wrong in WRONG:
                try_call(name, function, right, {option: wrong}, faults)
                calls += 1
    assert calls > 5000
    assert not faults, f"{len(faults)} of {calls}:\n" + "\n".join(faults)
    if scene.world.is_valid:
        scene.world.step(0.1)
        assert np.isfinite(scene.plant.get_state()).all()
