"""Draw the figure of the paper: the contact patch through one impact."""

from pathlib import Path

import carom

HERE = Path(__file__).parent
BALL = carom.Sphere(radius="5 mm", material="bearing-steel")
WALL = carom.HalfSpace(material="bearing-steel")
PAIR = carom.Pair(BALL, WALL, friction=0.2, roughness="30 nm")


def main(folder: str | Path = HERE) -> Path:
    """Draw contact.png in a folder, as wide as the text of the paper."""
    hit = carom.impact(PAIR, speed="0.6 m/s", angle="25 deg")
    assert hit.validity.holds, hit.validity
    path = Path(folder) / "contact.png"
    carom.plots.save_figure(carom.plots.plot_contact(hit, width=160), path)
    return path


if __name__ == "__main__":
    print(main())
