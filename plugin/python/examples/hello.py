"""A ball is thrown at a corn plant in PyBullet; prints what each feels."""

import frond.pybullet
import pybullet as p

client = p.connect(p.DIRECT)
p.setGravity(0, 0, -9.81)
world = frond.pybullet.attach(client)
plant = world.add_plant("corn")
ball = p.createMultiBody(0.3, p.createCollisionShape(p.GEOM_SPHERE, radius=0.05), basePosition=(0.25, 0, 0.8))
p.resetBaseVelocity(ball, (-3, 0, 1))
largest = 0.0
for _ in range(120):
    p.stepSimulation()
    largest = max(largest, abs(world.wrench_on(ball).force).max())

print(f"after half a second the tip is {plant.tip[2]:.3f} m high; the ball felt up to {largest:.1f} N")
assert largest > 1 and plant.tip[2] > 1.5
p.disconnect()
