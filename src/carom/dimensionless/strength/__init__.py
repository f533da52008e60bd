"""What an impact does to its bodies: the largest stresses through it, and cracks from flaws."""
