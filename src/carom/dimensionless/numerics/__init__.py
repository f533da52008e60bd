"""Numerical tools: compiling, threads, Chebyshev series, Hertz."""
