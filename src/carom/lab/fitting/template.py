"""An empty table for measurements, with what belongs where, that a spreadsheet leaves as it is."""

# A spreadsheet cuts a comment at each comma and puts it in quotes where it has some: none is here.
TEMPLATE = """\
# Write one impact per row below the head. Leave out columns that you did not measure. A - is a gap.
# Before: angle is that from the normal (0 is straight down). speed is that of the centre.
# After: normal_restitution is the normal speed after over that before. rebound_angle is
#   that from the normal: positive if the ball flies on and negative if it flies back. spin_out is
#   positive if it adds to the tangential speed of the contact point (backspin). A ball that strikes
#   without spin leaves with topspin and that is negative.
# For vertical drops write drop_height [mm] and rebound_height [mm] instead of all these columns.
# Angles from the surface are surface_angle and surface_angle_out. A spin without sign is
#   spin_out_magnitude.
# On a plate thinner than some six radii write its thickness below as well: plate_thickness: 20 mm
#   Then duration [us] is allowed after the impact: the contact time.
# Drops at one setting have one name in a column group.
# Standard deviations that you know have columns of their own: spin_out_error [rpm].
# The bodies are in the next lines. Give the radius and not the diameter.
# ball_radius: 10 mm
# ball_material: steel
# plate_material: steel
angle [deg],speed [m/s],normal_restitution,rebound_angle [deg],spin_out [rpm]
"""
