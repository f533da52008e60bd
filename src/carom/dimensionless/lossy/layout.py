"""Where an impact with losses keeps what it comes to, and what there is at an instant."""

# What an impact comes to; time, penetration and losses (normal, in shear) are those so far.
PSI_OUT, RESTITUTION, TIME, PENETRATION, LOST, SHEAR_LOST, DEEPEST, STRONGEST, WIDEST = range(9)
NUMBERS = 9

# What is kept of an instant; AT_SQUARE is the integral of u^2 over the contact.
AT_TIME, AT_D, AT_V, AT_PSI, AT_U, AT_Q, AT_P, AT_B, AT_STUCK, AT_SQUARE = range(10)
AT_STORED, AT_LOST, AT_SHEAR_LOST = 10, 11, 12
ROWS = 13
