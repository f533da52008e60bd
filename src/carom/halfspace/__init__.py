"""Boundary elements: the contact of an impact in three dimensions, with nothing assumed of slip."""
