"""A KUKA arm reaches through a corn plant: the force of its leaves on each link over time, and a picture.

    arm.py [FOLDER]     arm.png and arm_forces.png are written there
"""

import sys
from pathlib import Path

import frond.picture
import frond.pybullet
import numpy as np
import pybullet as p
import pybullet_data

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
client = p.connect(p.DIRECT)
p.setAdditionalSearchPath(pybullet_data.getDataPath())
p.setGravity(0, 0, -9.81)
p.loadURDF("plane.urdf")
arm = p.loadURDF("kuka_iiwa/model.urdf", (-0.55, 0, 0), useFixedBase=True)
world = frond.pybullet.attach(client)
plant = world.add_plant("corn", position=(0, 0.12, 0), mechanics="rod")

# The hand goes from the left of the plant to its right, and pushes stem and leaves aside.
joints = range(p.getNumJoints(arm))
time, forces, roots = [], [], []
for step in range(720):
    x, y = 0.05, -0.35 + 0.6 * min(step / 600, 1)
    pose = p.calculateInverseKinematics(arm, 6, (x, y, 0.75))
    p.setJointMotorControlArray(arm, joints, p.POSITION_CONTROL, targetPositions=pose, forces=[200] * len(joints))
    p.stepSimulation()
    time.append(step / 240)
    forces.append([np.linalg.norm(world.wrench_on(arm, link).force) for link in joints])
    roots.append(plant.root_force(mean=True).force)
    if step == 480:
        view = p.computeViewMatrixFromYawPitchRoll((-0.1, 0, 0.9), 2.6, 40, -12, 0, 2)
        projection = p.computeProjectionMatrixFOV(50, 4 / 3, 0.05, 20)
        image = frond.pybullet.camera_image(world, 800, 600, view, projection)
forces, roots = np.array(forces), np.array(roots)

print("largest force of the plant on each link [N]:", np.round(forces.max(axis=0), 2))
print("root force at rest and at its largest [N]:", np.round(roots[0], 2), np.round(roots[abs(roots).argmax() // 3], 2))
frond.picture.write_png(folder / "arm.png", image.rgb)
seen = np.unique(image.organs[image.organs >= 0])
print("organs in the picture:", ", ".join(plant.model.organs[i].name for i in seen))

import matplotlib  # noqa: E402

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

figure, axes = pyplot.subplots(figsize=(7, 4), layout="constrained")
for link in joints:
    if forces[:, link].max() > 0:
        axes.plot(time, forces[:, link], label=f"link {link}")
axes.set(xlabel="time [s]", ylabel="force of the plant [N]", title="A KUKA arm in a corn plant")
axes.legend()
figure.savefig(folder / "arm_forces.png", dpi=110)
assert forces.max() > 0.5 and (image.bodies == arm).any() and (image.plants == 0).any()
p.disconnect()
