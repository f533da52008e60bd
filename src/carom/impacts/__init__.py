"""One impact with units: solved, what comes of it, and how far the theory holds."""
