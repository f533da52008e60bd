"""Many impacts: arrays of collisions, rebound laws in closed form and as tables, sweeps."""
