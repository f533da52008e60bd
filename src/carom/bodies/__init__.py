"""Bodies: what they are made of, their shapes, pairs of them, and how they move."""
