"""Rebound laws: the exact one as a table, and those that are used in its place."""
