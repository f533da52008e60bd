"""The compiled library: built from the kernels with the package, and its functions in C."""
