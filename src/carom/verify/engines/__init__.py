"""DEM programs, driven through impacts of which the exact answer is known."""
