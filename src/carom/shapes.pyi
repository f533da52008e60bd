from .bodies.solids import clump as clump, cylinder as cylinder, ellipsoid as ellipsoid, rod as rod
