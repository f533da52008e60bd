"""Examples for a class: impacts with a story, and where their numbers are from."""

from typing import NamedTuple
from urllib.parse import urlencode


class Preset(NamedTuple):
    """An impact to begin with: its link's query, and what there is to see in it.

    `sources` say of each number where it was published or that it is assumed, `caution` where the
    theory of elastic spheres is stretched.
    """

    id: str
    title: str
    story: str
    query: str
    sources: tuple[str, ...]
    caution: str = ""


PHENOLIC = {"young": 5.8, "poisson": 0.34, "density": 1740}
POOL_BALL = {"radius": 28.575, "material": "own", **PHENOLIC}
POOL_BALLS = {
    **POOL_BALL,
    "against": "sphere",
    **{f"second_{name}": value for name, value in POOL_BALL.items()},
    "friction": 0.06,
    "speed": 1,
    "angle": 30,
}
SUPERBALL = {
    **{"radius": 23, "material": "own", "young": 0.01, "poisson": 0.5, "density": 910},
    **{"second_material": "granite", "friction": 0.7, "restitution": 0.9, "speed": 2.69},
}
GOLF_BALL = {
    **{"radius": 21.4, "material": "own", "young": 0.06, "poisson": 0.45, "density": 1096},
    **{"second_material": "granite", "friction": 0.075, "restitution": 0.9, "speed": 4},
}
SMALL_BALLS = {"radius": 1.59, "against": "sphere", "second_radius": 1.59, "angle": 20}
ALUMINA = {"radius": 2.5, "material": "alumina", "second_material": "soda-lime-glass"}

ALCIATORE = (
    "D. G. Alciatore, Billiards and Pool Physics, physical properties, billiards.colostate.edu: "
    "diameter 2.25 in, mass 6 oz (0.170 kg), ball-ball friction 0.03 to 0.08, restitution 0.92 to "
    "0.98. The density follows from mass and diameter."
)
POOL_ASSUMED = (
    "Assumed: Young's modulus 5.8 GPa and Poisson's ratio 0.34 of phenolic resin, and no losses. "
    "The modulus changes how long the balls touch, not how they leave."
)
CROSS_2002 = (
    "R. Cross (2002), Grip-slip behavior of a bouncing ball, American Journal of Physics "
    "70:1093-1102, doi 10.1119/1.1507792: superball of 46 mm and 46.4 g, 2.69 m/s, 36 degrees from "
    "the surface, restitution 0.91, spin 98.4 rad/s, horizontal speed ratio 0.59 (taken from "
    "svenviktorjonsson/rigid-body-collisions, which quotes its tables)."
)
RUBBER_ASSUMED = (
    "Assumed: Young's modulus 10 MPa, Poisson's ratio 0.5, restitution 0.9 in place of 0.91, a "
    "floor of granite, and friction 0.7; Cross could only tell that friction was not smaller than "
    "what he measured."
)
GARWIN = (
    "R. L. Garwin (1969), Kinematics of an ultraelastic rough ball, American Journal of Physics "
    "37:88-92."
)
CROSS_2010 = (
    "R. Cross (2010), Enhancing the bounce of a ball, The Physics Teacher 48: golf ball of 45 g on "
    "granite, about 4 m/s, 25 degrees from the normal, restitution 0.87, spin 14.8 rad/s for each "
    "m/s (taken from svenviktorjonsson/rigid-body-collisions, which quotes its Table I)."
)
LOUGE = (
    "M. Y. Louge (1999), Impact results, Cornell University, as in carom.datasets.parameters(): "
    "spheres of 3.18 mm, "
)
FOERSTER = (
    "S. F. Foerster, M. Y. Louge, H. Chang and K. Allia (1994), Measurements of the collision "
    "properties of small spheres, Physics of Fluids 6:1108-1115, doi 10.1063/1.868282: friction "
    "0.092, restitution 0.97, tangential restitution 0.44 with an error of 0.07."
)
KHARAZ = (
    "A. H. Kharaz, D. A. Gorham and A. D. Salman (2001), An experimental study of the elastic "
    "rebound of spheres, Powder Technology 120:281-291, doi 10.1016/S0032-5910(01)00283-2: "
    "diameter 5 mm, about 3.9 m/s; the data set kharaz2001 of Carom."
)
CHUNG = (
    "Y. C. Chung and J. Y. Ooi (2011), Benchmark tests for verifying discrete element modelling "
    "codes at particle impact level, Granular Matter 13:643-656: elastic constants, friction "
    "0.092, restitution 0.98."
)

PRESETS = (
    Preset(
        "throw",
        "Billiard balls: throw",
        "A cue ball without spin meets a resting ball at 1 m/s, 30° off the line of centres: a "
        "half-ball hit. The surfaces slide over each other to the end. Friction therefore throws "
        "the object ball arctan 0.06 = 3.43° off that line, and gives each ball a spin of "
        "4.55 rad/s. Try 10°: the balls now grip for a while, and throw falls to 2.14°.",
        urlencode(POOL_BALLS),
        (ALCIATORE, POOL_ASSUMED),
        "Friction of real balls falls as they slide faster. The contact is nearly as large as "
        "Hertz's theory allows, so keep to slow shots.",
    ),
    Preset(
        "gearing",
        "Billiard balls: gearing",
        "The same hit with a side spin of 17.5 rad/s against the motion. Where the balls touch, "
        "their surfaces now move alike, as two gear wheels do. Nothing rubs, so the object ball "
        "leaves along the line of centres and takes no spin. Double the spin, and the ball is "
        "thrown by 3.43° to the other side.",
        urlencode({**POOL_BALLS, "spin": -17.4978}),
        (ALCIATORE, POOL_ASSUMED),
        "The contact is nearly as large as Hertz's theory allows, so keep to slow shots.",
    ),
    Preset(
        "superball",
        "Superball: more than rolling",
        "A superball strikes without spin at 2.69 m/s, 54° from the normal. If it only slid until "
        "it rolled, it would leave with 67.6 rad/s. It grips instead, is sheared, and springs "
        "back: it leaves with 98.3 rad/s and 0.585 of its tangential speed, its contact point "
        "moving backwards. Cross measured 98.4 rad/s and 0.59.",
        urlencode({**SUPERBALL, "angle": 54}),
        (CROSS_2002, GARWIN, RUBBER_ASSUMED),
        "The ball is pressed too flat for Hertz's theory: the contact radius is 0.23 of the "
        "ball's, where 0.1 is the limit. The impact is also so short that elastic waves matter.",
    ),
    Preset(
        "superball-back",
        "Superball: thrown with backspin",
        "Throw the superball at 20° with a backspin of 120 rad/s. Its contact point moves forward "
        "so fast that friction reverses spin and flight alike: the ball comes back at 15.4° with "
        "48.0 rad/s of the opposite spin. Garwin explained in this way why a ball that is thrown "
        "under a table returns to the hand.",
        urlencode({**SUPERBALL, "angle": 20, "spin": 120}),
        (GARWIN, CROSS_2002, RUBBER_ASSUMED),
        "The ball is pressed too flat for Hertz's theory: the contact radius is 0.28 of the "
        "ball's, where 0.1 is the limit. The impact is also so short that elastic waves matter.",
    ),
    Preset(
        "golf",
        "Golf ball: which friction?",
        "A golf ball meets granite at 4 m/s, 25° from the normal. It slides to the end with a "
        "friction of 0.075 and leaves with 60.3 rad/s; Cross measured 59.2. Raise friction to "
        "0.15: a solid ball grips, springs back, and spins with 83.6 rad/s. One angle alone can "
        "hardly tell how a ball grips, so measure at several.",
        urlencode({**GOLF_BALL, "angle": 25}),
        (
            CROSS_2010,
            "Assumed: Young's modulus 60 MPa and Poisson's ratio 0.45 of a ball without layers, "
            "restitution 0.9 in place of 0.87. Friction is chosen so that the spin is about the "
            "measured one.",
        ),
        "A golf ball has layers, and the theory takes it for one solid. The contact radius is 0.24 "
        "of the ball's, where 0.1 is the limit; elastic waves matter; and normal and tangential "
        "contact couple, as the materials are unlike, which the theory neglects.",
    ),
    Preset(
        "steel",
        "Steel on steel",
        "Two small bearing balls meet at 0.3 m/s and 20°. Hardened steel loses next to nothing: "
        "Louge lists a restitution of 1.00 and a friction of 0.12. The balls slide, stick for a "
        "moment, and spring back, so that the contact point leaves backwards with 0.462 of its "
        "speed; balls that stuck had 0.54 with an error of 0.05.",
        urlencode({**SMALL_BALLS, "friction": 0.12, "speed": 0.3}),
        (
            f"{LOUGE}chrome steel: restitution 1.00, friction 0.12, tangential restitution 0.54 "
            "with an error of 0.05.",
            "Assumed: a speed at which the steel does not yet yield.",
        ),
        "From about 0.45 m/s on these balls yield, and an elastic theory ends.",
    ),
    Preset(
        "glass",
        "Glass on glass",
        "Two glass beads of 3.18 mm meet in flight at 1.2 m/s and 20°, as Foerster photographed "
        "them. They hardly stick: gross slip one way becomes a slip ring the other way. The "
        "contact point leaves backwards with 0.428 of its speed, where 0.44 was measured, with an "
        "error of 0.07. Try 40°, where the beads slide to the end.",
        urlencode(
            {
                **SMALL_BALLS,
                **{"material": "soda-lime-glass", "second_material": "soda-lime-glass"},
                **{"friction": 0.092, "speed": 1.2},
            }
        ),
        (
            FOERSTER,
            "Assumed: usual elastic constants of soda-lime glass, and no losses in place of a "
            "restitution of 0.97.",
        ),
    ),
    Preset(
        "alumina",
        "Alumina on glass: Kharaz",
        "The most careful measurement of all: alumina balls of 5 mm fall on thick glass at 3.9 "
        "m/s. At 20° the tangential speed falls to 0.592 of what it was; Kharaz and his "
        "colleagues measured 0.597. Closer to the normal the balls stick and further from it they "
        "slide to the end, and they keep more of their speed in both cases. Turn the angle, and "
        "watch the regime change.",
        urlencode({**ALUMINA, "friction": 0.092, "speed": 3.9, "angle": 20}),
        (KHARAZ, CHUNG, "Assumed: no losses in place of a restitution of 0.98."),
        "Alumina is much stiffer than glass. Pressing therefore also shears the contact: normal "
        "and tangential contact couple, which the theory neglects. ψ₂ may be off by up to 0.64 "
        "here.",
    ),
    Preset(
        "no-spin",
        "A ball that leaves without spin",
        "A steel ball strikes a plate at 20° with a backspin of 112.8 rad/s, and leaves without "
        "any, at 2.06° on the side that it came from. It slides to the end, so friction takes the "
        "same spin from it whatever it had: from 100 rad/s it leaves with 12.8 rad/s of topspin, "
        "from 150 with 37.2 rad/s of backspin.",
        urlencode({"speed": 0.6, "angle": 20, "spin": 112.763114494309}),
        (
            "Bearing steel as in Carom's catalogue of materials (Metals Handbook Desk Edition, "
            "ASM, 1985).",
            "Assumed: friction 0.2, no losses.",
        ),
    ),
)
