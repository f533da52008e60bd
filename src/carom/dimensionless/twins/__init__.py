"""Independent solvers that the phase machine is compared with."""
