"""The oblique impact of Kelvin-Voigt solids: stick inside one ring of slip, panel by panel."""
