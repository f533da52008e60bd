r"""Score a contact law of your own
===============================

`carom.verify.score` runs a contact law that is a Python function and compares its rebounds with the
exact ones.

The function gets the contact in each time step and the state that it returned in the step before.
This one is a linear spring with a slider, and its state is the stretch of the spring.
"""

import carom


def my_law(contact, stretch):
    """Return the force along x on the first body, and the new state."""
    stretch += contact.tangential_velocity * contact.time_step
    force = -contact.tangential_stiffness * stretch
    limit = contact.friction * abs(contact.normal_force)
    if abs(force) > limit:
        force = limit if force > 0 else -limit
        stretch = -force / contact.tangential_stiffness
    return force, stretch


score = carom.verify.score(my_law)
print(score)
score.plot("own_law.png")

# %%
# Check: it is what LAMMPS calls `mindlin`, with the same error.
assert not score.passed
known = carom.verify.score(carom.dem.LammpsMindlin("mindlin"))
assert abs(score.max_error - known.max_error) < 0.01
