"""The same beam, held at one end, by PyBullet's loadSoftBody (neo-Hookean) and by Frond: sag and time, in one run.

The beam is 0.5 x 0.1 x 0.1 m of E = 1 MPa, Poisson's ratio 0.3, 1000 kg/m^3: rather far from what bends much, so that
Timoshenko's beam says how far it should sag.
"""

import sys
import tempfile
import time
from pathlib import Path

import frond
import frond.pybullet
import numpy as np
import pybullet as p

LENGTH, SIDE, YOUNG, POISSON, DENSITY, G = 0.5, 0.1, 1e6, 0.3, 1000.0, 9.81
CELLS = (10, 2, 2)
SECONDS = float(sys.argv[1]) if len(sys.argv) > 1 else 3.0


def beam():
    """Returns nodes and tets of a lattice of cubes, five tets each."""
    counts = [cells + 1 for cells in CELLS]
    number = np.arange(np.prod(counts)).reshape(counts)
    scale = np.array([LENGTH, SIDE, SIDE]) / CELLS
    nodes = np.stack(np.meshgrid(*[np.arange(count) for count in counts], indexing="ij"), -1).reshape(-1, 3) * scale
    tets = []
    for i, j, k in np.ndindex(*CELLS):
        c = [number[i + a, j + b, k + d] for a, b, d in np.ndindex(2, 2, 2)]
        even = [(0, 4, 2, 1), (6, 2, 4, 7), (5, 4, 1, 7), (3, 1, 2, 7), (1, 2, 4, 7)]
        odd = [(1, 5, 0, 3), (2, 0, 6, 3), (4, 0, 5, 6), (7, 5, 3, 6), (0, 5, 6, 3)]
        tets += [[c[v] for v in tet] for tet in (even if (i + j + k) % 2 == 0 else odd)]
    return nodes - [0, SIDE / 2, SIDE / 2], np.array(tets, np.int32)


def write_vtk(path, nodes, tets):
    lines = ["# vtk DataFile Version 2.0", "beam", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(nodes)} double"]
    lines += [" ".join(map(str, node)) for node in nodes]
    lines += [f"CELLS {len(tets)} {5 * len(tets)}"] + ["4 " + " ".join(map(str, tet)) for tet in tets]
    path.write_text("\n".join(lines + [f"CELL_TYPES {len(tets)}"] + ["10"] * len(tets)) + "\n")


def run(heights):
    """Returns the mean of heights over the last second, in which the beam may still sway, and CPU s per s."""
    spent, places = 0.0, []
    for step in range(int(240 * SECONDS)):
        begin = time.process_time()
        p.stepSimulation()
        spent += time.process_time() - begin
        if step >= 240 * (SECONDS - 1):
            places.append(np.mean(heights()))
    return float(np.mean(places)), spent / SECONDS


def sag_of_soft_body(nodes, tets, substeps):
    """Returns the sag of the free end [m], and the CPU seconds of a simulated second."""
    client = p.connect(p.DIRECT)
    p.resetSimulation(p.RESET_USE_DEFORMABLE_WORLD)
    p.setGravity(0, 0, -G)
    p.setTimeStep(1 / 240)
    p.setPhysicsEngineParameter(numSubSteps=substeps)
    with tempfile.TemporaryDirectory() as folder:
        write_vtk(Path(folder, "beam.vtk"), nodes, tets)
        mu, lam = YOUNG / (2 * (1 + POISSON)), YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
        body = p.loadSoftBody(str(Path(folder, "beam.vtk")), mass=DENSITY * LENGTH * SIDE**2, useNeoHookean=1,
                              NeoHookeanMu=mu, NeoHookeanLambda=lam, NeoHookeanDamping=0.01, useSelfCollision=0,
                              collisionMargin=0.001)
    vertices = np.array(p.getMeshData(body, -1, flags=p.MESH_DATA_SIMULATION_MESH)[1])
    for number in np.nonzero(vertices[:, 0] < 1e-6)[0]:
        p.createSoftBodyAnchor(body, int(number), -1, -1)
    end = vertices[:, 0] > LENGTH - 1e-6
    sag, spent = run(lambda: np.array(p.getMeshData(body, -1, flags=p.MESH_DATA_SIMULATION_MESH)[1])[end, 2])
    p.disconnect(client)
    return vertices[end, 2].mean() - sag, spent


def sag_of_frond(model, **settings):
    client = p.connect(p.DIRECT)
    p.setGravity(0, 0, -G)
    p.setTimeStep(1 / 240)
    world = frond.pybullet.attach(client, sleep_distance=0)
    plant = world.add_plant(model, root_height=-1, **settings)
    before, _ = plant.get_state()
    along = np.ptp(before, axis=0).argmax()
    held = np.nonzero(before[:, along] - before[:, along].min() < 1e-6)[0]
    for node in held:
        plant.pin(int(node))
    end = before[:, along] > before[:, along].max() - 1e-6
    sag, spent = run(lambda: plant.get_state()[0][end, 2])
    p.disconnect(client)
    return before[end, 2].mean() - sag, spent


def main():
    nodes, tets = beam()
    load, inertia = DENSITY * G * SIDE**2, SIDE**4 / 12
    shear = YOUNG / (2 * (1 + POISSON)) * SIDE**2 * 10 * (1 + POISSON) / (12 + 11 * POISSON)
    expected = load * LENGTH**4 / (8 * YOUNG * inertia) + load * LENGTH**2 / (2 * shear)
    material = frond.default_material()
    settings = {name: getattr(material, name) for name in material.__dataclass_fields__}
    settings.update(density=DENSITY, young=YOUNG, poisson=POISSON, hollow=0, yield_strain=0, creep_rate=0, strength=0,
                    damping_ratio=0.2)
    organs = {kind: settings for kind in ("stem",)}
    # The file's y is up; the beam lies along x, as PyBullet's.
    model = frond.Model.from_tets(nodes[:, [0, 2, 1]], tets, organs=organs, scale=1, up=(0, 1, 0))
    print(f"{len(tets)} tets, {SECONDS:g} s at 1/240 s; a Timoshenko beam sags by {1000 * expected:.1f} mm")
    print(f"{'':42}{'sag [mm]':>10}{'CPU s per s':>13}")
    rows = [(f"PyBullet, neo-Hookean, {count} substeps", lambda count=count: sag_of_soft_body(nodes, tets, count))
            for count in (1, 4)]
    for order in (1, 2):
        for mechanics in ("tet_corotational", "tet_neohookean"):
            rows.append((f"Frond, {mechanics}, element order {order}", lambda m=mechanics, o=order: sag_of_frond(
                model, mechanics=m, element_order=o)))
    results = {}
    for name, run in rows:
        results[name] = run()
        print(f"{name:42}{1000 * results[name][0]:10.1f}{results[name][1]:13.3f}", flush=True)
    best = results["Frond, tet_neohookean, element order 2"]
    assert abs(best[0] / expected - 1) < 0.1, best


if __name__ == "__main__":
    main()
