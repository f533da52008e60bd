"""An empty table for measurements, with what belongs where."""

TEMPLATE = """\
# A row an impact. Fill in below the head; leave out columns you did not measure; "-" is a gap.
# Before: angle, from the normal (0 is straight down); speed, of the centre.
# After: normal_restitution, normal speed after over before; rebound_angle, from the normal,
#   positive if the ball flies on, negative if it flies back; spin_out, positive if it adds to the
#   tangential speed of the contact point: backspin. A ball that strikes without spin leaves with
#   topspin, which is negative.
# Of vertical drops, drop_height [mm] and rebound_height [mm] instead of all these.
# Standard deviations, if you know them, in columns of their own: spin_out_error [rpm].
# The bodies; a radius, not a diameter:
# case: {"first": {"radius": "10 mm", "material": "steel"}, "second": {"material": "steel"}}
angle [deg],speed [m/s],normal_restitution,rebound_angle [deg],spin_out [rpm]
"""
