"""The exact contact law as a plugin for LAMMPS."""
