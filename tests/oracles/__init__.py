"""Independent solvers that the tests compare Carom with: slow, plain, and none of its code."""
