r"""Find the best stiffness for a DEM law
=====================================

`carom.verify.tune` finds the stiffness with which a contact law comes closest to the exact rebound.

No stiffness makes these laws exact, but a softer tangential spring divides the largest error of the
commonest laws by two to ten. `advised_steps` says how short the time step must be.
"""

import carom

bead = carom.Sphere(radius="1 mm", material="soda-lime-glass")
pair = carom.Pair(bead, bead, friction=0.1)
bodies = {"chi": pair.chi, "kappa": pair.kappa}
laws = [carom.dem.LinearSpring(), carom.dem.LammpsMindlin("mindlin_rescale/force")]

tuning = carom.verify.tune(laws, **bodies)
for best in tuning.advice:
    step = carom.verify.advised_steps(best.law, 0.01, **bodies)
    print(f"{best.law.name}: {best.parameter} = {best.value:.3f}", end=", ")
    print(f"error {best.before:.3f} becomes {best.max_error:.3f}, {step.steps} steps a contact")

score = carom.verify.score(tuning.advice[0].law, chi=pair.chi, tolerance=0.1)
score.plot("best_stiffness.png")

# %%
# Check: linear springs should be a little softer than elastic bodies, and ten steps are too few.
(spring,) = (best for best in tuning.advice if best.parameter == "stiffness_ratio")
assert 0.8 * pair.kappa < spring.value < pair.kappa
assert spring.max_error < 0.6 * spring.before
assert carom.verify.step_error(spring.law, 10, **bodies) > 0.01
