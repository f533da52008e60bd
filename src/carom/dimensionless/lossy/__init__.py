"""The oblique impact with losses in the normal motion, panel by panel."""
