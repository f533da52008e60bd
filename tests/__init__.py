"""The tests of Carom, by kind of truth; a package, so that they can share `tests.oracles`."""
