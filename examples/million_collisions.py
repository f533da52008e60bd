"""Compute a million collisions
============================

`carom.collide` takes arrays of velocities, spins and normals, and returns them after the collision.

This is the exact law at some 20 ns a collision. Pairs that do not approach are left alone and have
a status of their own. The picture shows the spins of smooth spheres after their first collision.
"""

import numpy as np

import carom
from carom.plots.style import BLUE, new_figure, save_figure, style

ball = carom.Sphere(radius="5 mm", material="soda-lime-glass")
pair = carom.Pair(ball, ball, friction=0.1)
rng = np.random.default_rng(1)
velocity1, velocity2, normal = rng.normal(size=(3, 1_000_000, 3))  # m/s
normal /= np.linalg.norm(normal, axis=1, keepdims=True)  # from the first body to the second

after = carom.collide(pair, velocity1=velocity1, velocity2=velocity2, normal=normal)
hit = after.status == 0
print(after)

with style():
    figure, ((axis,),) = new_figure()
    spins = np.linalg.norm(after.spin1[hit], axis=1)
    axis.hist(spins, bins=100, range=(0, 250), density=True, color=BLUE)
    axis.set(xlabel="spin after the collision (rad/s)", ylabel="share per rad/s", xlim=(0, 250))
    save_figure(figure, "million_collisions.png")

# %%
# Check: momentum is kept in each collision, and no collision gains energy.
np.testing.assert_allclose(after.velocity1 + after.velocity2, velocity1 + velocity2, atol=1e-13)


def energy(*motions):
    return sum(np.sum(np.square(each), axis=1) for each in motions)


turned = 0.4 * ball.radius**2 * energy(after.spin1, after.spin2)
left = energy(after.velocity1, after.velocity2) + turned
before = energy(velocity1, velocity2)
assert np.all(left <= before * (1 + 1e-12))
