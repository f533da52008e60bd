"""The oblique impact with losses: viscoelastic solids, spheres that yield."""
