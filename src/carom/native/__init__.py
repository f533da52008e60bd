"""The compiled library: built from the kernels together with the package, and its functions in C."""
