"""The oblique impact of spheres that yield, panel by panel."""
