"""Impacts of yielding spheres and of standard linear solids, marched in time over springs."""
