"""An empty table for measurements, with what belongs where."""

TEMPLATE = """\
# Write one impact per row below the head. Leave out columns that you did not measure; "-" is a gap.
# Before the impact: angle is that from the normal (0 is straight down), speed that of the centre.
# After the impact: normal_restitution is the normal speed after over that before. rebound_angle is
#   that from the normal, positive if the ball flies on, negative if it flies back. spin_out is
#   positive if it adds to the tangential speed of the contact point (backspin). A ball that strikes
#   without spin leaves with topspin, which is negative.
# For vertical drops write drop_height [mm] and rebound_height [mm] instead of all these columns.
# Angles from the surface are surface_angle and surface_angle_out, spins without sign
#   spin_out_magnitude.
# For a plate thinner than some six radii add its "thickness" to the "second" body below; then
#   duration [us], the contact time, may be a column after the impact, too.
# Standard deviations, if you know them, have columns of their own: spin_out_error [rpm].
# The bodies are in the next line; give the radius, not the diameter.
# case: {"first": {"radius": "10 mm", "material": "steel"}, "second": {"material": "steel"}}
angle [deg],speed [m/s],normal_restitution,rebound_angle [deg],spin_out [rpm]
"""
