"""A pull test: force over displacement of a mesh of your own, held at its foot and pulled sideways at its stem.

    stiffness.py [MESH [PNG]]     corn and stiffness.png, if not given
"""

import sys

import frond
import numpy as np

mesh = sys.argv[1] if len(sys.argv) > 1 else "corn"
png = sys.argv[2] if len(sys.argv) > 2 else "stiffness.png"
model = frond.Model(mesh)
height = model.chain.nodes[:, 1].max()
displacements = np.linspace(0, 0.03 * height, 6)

# A point of the stem, or of what is heaviest, at 0.6 of the height.
stem = int(np.argmax([organ.mass + 1e9 * (organ.kind == "stem") for organ in model.organs]))
nodes = model.chain.nodes[model.chain.parents >= 0][model.capsule_organs == stem]
point = nodes[np.argmin(np.abs(nodes[:, 1] - 0.6 * height))]


def pull(mechanics):
    """Returns the force [N] at each displacement. A clamp far away moves, and the stem with it."""
    world = frond.World(sleep_distance=0)
    plant = world.add_plant(model, mechanics=mechanics, integrator="implicit_euler")
    clamp = world.add_rigid(mass=0, position=(0, 10 * height, 0))
    bond = plant.bond(point, clamp)
    forces = []
    for displacement in displacements:
        clamp.set_state(position=(displacement, 10 * height, 0))
        for _ in range(600):
            world.step(1 / 60)
        forces.append(bond.force(mean=True)[0])
    root = plant.root_force().force[0]
    print(f"{mechanics}: {forces[-1]:.2f} N hold the stem {displacements[-1]:.3f} m aside, the root by {root:.2f} N")
    assert abs(root + forces[-1]) < 0.01 * forces[-1]
    return np.array(forces)


curves = {mechanics: pull(mechanics) for mechanics in ("rod", "tet_corotational")}
assert all((np.diff(forces) > 0).all() for forces in curves.values())

import matplotlib  # noqa: E402

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

figure, axes = pyplot.subplots(figsize=(6, 4), layout="constrained")
for name, forces in curves.items():
    axes.plot(displacements, forces, "o-", label=name)
axes.set(xlabel="displacement [m]", ylabel="force [N]", title=f"Pull test: {mesh}")
axes.legend()
figure.savefig(png, dpi=110)
