"""The exact contact law in DEM programs: a plugin for LAMMPS, a model for LIGGGHTS."""
