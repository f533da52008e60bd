"""Oblique elastic impact to many digits: Taylor series, the slip front read off the memory.

The independent variable is tau, dtau = dt/(2 sqrt d), in which everything is analytic at first
touch and at maximum penetration: b' = v, v' = -(5/2) b^4, psi' = -(15/2) chi b Q, U' = 2 b psi. In
a slip ring Q = sign (2/3 b^3 - K), K being the integral of a dF over the memory the front has
crossed. Units: length d_max, time d_max/V_1, tangential displacement mu d_max/kappa.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from mpmath import mp, mpf

from tests.oracles.power_series import Series, first_root, next_root_term, product, shifted, term

ZERO = mpf(0)
STATE = ("tau", "t", "b", "v", "psi", "U", "Q")


@dataclass(frozen=True)
class Accuracy:
    """Decimal digits carried, order of the Taylor series and truncation error allowed in a step."""

    digits: int = 52
    order: int = 48
    truncation: str = "1e-44"


@dataclass
class Memory:
    """A ring of contact whose springs carry q = U + offset when stuck; both series are in `place`
    - `origin`.

    `place` is the loading time tau of stick-laid contact, the radius of slip-laid contact.
    """

    laid_by: int
    inner: mpf
    outer: mpf
    origin: mpf
    radius: Series
    offset: Series


@dataclass
class Step:
    """One Taylor step: every quantity of the state, and the front's place, in powers of y on [0,
    length].
    """

    kind: str
    sign: int
    series: dict[str, Series]
    length: mpf = ZERO
    ring: Memory | None = None
    leads: bool = False

    def radius_of(self, place: mpf) -> mpf:
        """Radius of a place in the ring of memory that the front is in."""
        return mp.polyval(self.ring.radius[::-1], place - self.ring.origin)

    def at_end(self, name: str) -> mpf:
        """The value at the end of the step."""
        return mp.polyval(self.series[name][::-1], self.length)


@dataclass
class Phase:
    """A phase of the impact, with the way it ended."""

    kind: str
    sign: int
    start: mpf
    end: mpf = ZERO
    cause: str = ""


@dataclass
class Impact:
    """A solved impact; `steps` and `memories` (the memory at the end of each phase) serve the
    checks.
    """

    psi_1: mpf
    chi: mpf
    phases: list[Phase] = field(default_factory=list)
    steps: list[Step] = field(default_factory=list)
    memories: list[tuple[int, list[Memory]]] = field(default_factory=list)
    features: set[str] = field(default_factory=set)
    psi_out: mpf = ZERO


class Front:
    """The slip front in one ring of memory: F(place) = l, solved order by order."""

    def __init__(
        self, ring: Memory, place: mpf, sign: int, order: int, leads: bool, double: bool
    ) -> None:
        """Expand F and K, the integral of a dF, about the front's place."""
        radius, offset = (shifted(s, place - ring.origin) for s in (ring.radius, ring.offset))
        if leads:  # the independent variable is then the distance covered by the front
            radius, offset = ([c * (-1) ** j for j, c in enumerate(s)] for s in (radius, offset))
        square = product(radius, radius, order + 1)
        force = [x + sign * y for x, y in zip(square, offset + [ZERO] * (order + 2), strict=False)]
        self.force = force
        self.slope = [j * c for j, c in enumerate(force)][1:]
        self.work = [ZERO] + [c / (j + 1) for j, c in enumerate(product(radius, self.slope, order))]
        self.place, self.leads, self.double, self.law_value = place, leads, double, force[0]
        self.law, self.curve = force, force[2]
        if double:  # the front starts as a mirror image of the load: take the root of a double root
            square = [c / self.curve for c in force[2:]]
            root: Series = []
            while len(root) < len(square):
                root.append(next_root_term(root, square))
            self.law = [ZERO, *root]
        self.powers: list[Series] = [[ZERO]]
        self.root: Series = []

    def advance(self, limit: Series) -> mpf:
        """Find the next coefficient of the front's place from those of l, and return that of K."""
        k = len(self.powers[0])
        place = self.powers[0]
        if k > 1:
            self.powers.append([ZERO] * k)
        for j in range(1, k):
            below = self.powers[j - 1]
            self.powers[j].append(mp.fdot(place[1 : k - j + 1], below[k - 1 : j - 1 : -1]))
        if self.double:
            self.root.append(next_root_term(self.root, [c / self.curve for c in limit[2:]]))
        values = -self.root[-1] if self.double else limit[k]
        column = [self.powers[j][k] for j in range(1, k)]
        place.append((values - mp.fdot(self.law[2 : k + 1], column)) / self.law[1])
        return mp.fdot(self.work[1 : k + 1], [place[k], *column])


def expanded(
    kind: str, sign: int, state: dict[str, mpf], chi: mpf, order: int, front: Front | None
) -> Step:
    """Taylor series of the state in tau, or in the distance the front has covered."""
    s: dict[str, Series] = {name: [value] for name, value in state.items()}
    tau, t, b, v, psi, disp, q = (s[name] for name in STATE)
    leads = front is not None and front.leads
    b2, b3, b4, bq, bpsi, rate, limit = ([ZERO] * 0 for _ in range(7))
    pace: Series = []
    for k in range(order + 1):
        b2.append(term(b, b, k))
        b3.append(term(b2, b, k))
        b4.append(term(b2, b2, k))
        bpsi.append(term(b, psi, k))
        rate.append(2 * (term(b, v, k) - sign * bpsi[k]))
        if leads:
            pace.append((front.slope[k] - mp.fdot(pace, rate[k:0:-1])) / rate[0])
        else:
            pace.append(mpf(not k))
        n = k + 1
        tau.append(pace[k] / n)
        t.append(2 * term(b, pace, k) / n)
        b.append(term(v, pace, k) / n)
        v.append(-term(b4, pace, k) * 5 / (2 * n))
        disp.append(2 * term(bpsi, pace, k) / n)
        if k:
            q.append(held_force(kind, sign, k, b2, b3, psi))
            if front is not None and leads:
                q[k] -= sign * front.work[k]
            elif front is not None:
                limit = [*b2, term(b, b, n)]
                q[k] -= sign * front.advance(
                    [x - sign * y for x, y in zip(limit, disp, strict=True)]
                )
        bq.append(term(b, q, k))
        psi.append(-term(bq, pace, k) * 15 * chi / (2 * n))
    if front is not None:
        s["place"] = [front.place, mpf(-1)] if leads else [front.place, *front.powers[0][1:]]
    return Step(kind, sign, {name: (c + [ZERO] * order)[: order + 1] for name, c in s.items()})


def held_force(kind: str, sign: int, k: int, b2: Series, b3: Series, psi: Series) -> mpf:
    """Coefficient k of Q, but for what the front takes from it."""
    return 2 * term(b2, psi, k - 1) / k if kind == "stick" else sign * mpf(2) / 3 * b3[k]


def reach(step: Step, truncation: mpf) -> mpf:
    """The step length at which the last terms of the series are as small as asked."""
    last = [abs(c[j]) for c in step.series.values() for j in (-1, -2)]
    order = len(step.series["b"]) - 1
    return min((truncation / c) ** (mpf(1) / (order - i % 2)) for i, c in enumerate(last) if c)


class Solver:
    """Follows one impact from first touch to separation, phase by phase."""

    def __init__(self, psi_1: mpf, chi: mpf, accuracy: Accuracy) -> None:
        """Start at first touch, with no memory."""
        self.chi, self.order, self.truncation = chi, accuracy.order, mpf(accuracy.truncation)
        self.turn = mp.beta(mpf(1) / 5, mpf(1) / 2) / 5  # tau at maximum penetration
        self.state = dict.fromkeys(STATE, ZERO) | {"v": mpf(1), "psi": psi_1}
        self.memory: list[Memory] = []
        self.impact = Impact(psi_1, chi)

    def solve(self) -> Impact:
        """Run all phases."""
        out, psi_1 = self.impact, self.impact.psi_1
        # at |psi_1| = 1 the next term in time decides, and it has the sign of 2 chi - 1
        sticks = abs(psi_1) < 1 or (abs(psi_1) == 1 and self.chi > mpf(1) / 2)
        kind, sign = ("stick", 0) if sticks else ("gross slip", int(mp.sign(psi_1)))
        self.note(f"{kind} from the start")
        while kind:
            start, name = self.state["t"], kind
            follow = {"stick": self.stick, "slip": self.slip, "gross slip": self.gross_slip}[kind]
            cause, kind, after = follow(sign)
            if self.state["t"] > start:
                out.phases.append(Phase(name, sign, start, self.state["t"], cause))
                out.memories.append((len(out.steps), [replace(ring) for ring in self.memory]))
                self.note(f"{cause} ({name})")
            elif cause.startswith("front"):
                self.note("ring closes on own slip: gross slip at once")
            sign = after
        if len(out.phases) == 1:
            self.note(f"{name} throughout")
        out.psi_out = self.state["psi"]
        return out

    def note(self, feature: str) -> None:
        """Record that the run has met a feature, and on which half of the impact."""
        timeless = any(word in feature for word in ("start", "at once", "throughout"))
        half = " loading" if self.state["v"] > 0 else " unloading"
        self.impact.features.add(feature if timeless else feature + half)

    def take(self, step: Step, events: dict[str, Series], fresh: bool, last: str = "") -> str:
        """End the step at its first event, move the state there and name the event (`last` if
        there is none).
        """
        by_name = {name: first_root(series, step.length, fresh) for name, series in events.items()}
        by_name = {name: root for name, root in by_name.items() if root is not None}
        last = min(by_name, key=by_name.__getitem__) if by_name else last
        step.length = by_name.get(last, step.length)
        self.impact.steps.append(step)
        self.state = {name: step.at_end(name) for name in STATE}
        return last

    def stick(self, _: int) -> tuple[str, str, int]:
        """Stick while loading, until psi reaches v or -v at the edge."""
        event, fresh = "", True
        while not event:
            tau = self.state["tau"]
            step = expanded("stick", 0, self.state, self.chi, self.order, None)
            step.length = min(reach(step, self.truncation), self.turn - tau)
            if step.length <= 0:
                raise ArithmeticError("the load retraces its path")
            pairs = list(zip(step.series["v"], step.series["psi"], strict=True))
            margins = {str(n): [v - n * psi for v, psi in pairs] for n in (1, -1)}
            event, fresh = self.take(step, margins, fresh), False
            laid = [-c for c in step.series["U"]]
            self.memory.append(Memory(0, tau, self.state["tau"], tau, step.series["b"], laid))
        return "slip starts", "slip", int(event)

    def slip(self, sign: int) -> tuple[str, str, int]:
        """Slip in a ring, until its rate vanishes, it closes or its front reaches the centre."""
        fresh, double = True, self.impact.phases[-1].kind == "stick"
        while self.find_ring(sign, fresh):
            ring = self.memory[-1]
            step = self.ring_step(sign, ring, double)
            place, leads = step.series["place"], step.leads
            mirror = [(0 if k else 2 * self.turn) - c for k, c in enumerate(step.series["tau"])]
            edge = step.series["b"] if ring.laid_by else mirror
            events = {
                "rate": self.slip_rate(step),
                "closing": [x - y for x, y in zip(edge, place, strict=True)],
            }
            room = place[0] - ring.inner
            ends = leads and step.length >= room
            step.length = room if ends else step.length
            if not leads:
                events["inner"] = [room, *place[1:]]
            event = self.take(step, events, fresh, "inner" if ends else "")
            ring.outer = step.at_end("place")
            if event == "rate":
                return self.stop(sign, step.radius_of(ring.outer))
            if event == "closing":
                return "ring closes", "slip", -sign
            if event == "inner":
                if ring.laid_by:
                    self.note("front crosses opposite slip")
                self.memory.pop()
            fresh = double = False
        return "front reaches the centre", "gross slip", sign

    def find_ring(self, sign: int, fresh: bool) -> bool:
        """Let the front jump across slip of its own sign, where F is flat; False if nothing is
        left inside.
        """
        while self.memory and self.memory[-1].laid_by == sign:
            self.note("front jumps " + ("as its slip starts" if fresh else "across own slip"))
            self.memory.pop()
        return bool(self.memory)

    def ring_step(self, sign: int, ring: Memory, double: bool) -> Step:
        """Expand about the present front in tau, or in the place of the front if it is faster."""
        s = self.state
        front = Front(ring, ring.outer, sign, self.order, leads=False, double=double)
        if abs(front.law_value - (s["b"] ** 2 - sign * s["U"])) > mpf(10) ** (20 - mp.dps):
            raise ArithmeticError("the memory is not continuous at the front")
        if not double and abs(front.slope[0]) < abs(2 * s["b"] * (s["v"] - sign * s["psi"])):
            front = Front(ring, ring.outer, sign, self.order, leads=True, double=False)
        step = expanded("slip", sign, s, self.chi, self.order, front)
        step.ring, step.leads = replace(ring), front.leads
        step.length = min(reach(step, self.truncation), 2 * self.turn - s["tau"])
        return step

    def gross_slip(self, sign: int) -> tuple[str, str, int]:
        """Slip everywhere, until its rate vanishes or the bodies part."""
        fresh, left = True, mpf(1)
        self.memory.clear()
        while left > 0:
            step = expanded("gross slip", sign, self.state, self.chi, self.order, None)
            left = 2 * self.turn - self.state["tau"]
            step.length = min(reach(step, self.truncation), left)
            left -= step.length
            if self.take(step, {"rate": self.slip_rate(step)}, fresh):
                return self.stop(sign, ZERO)
            fresh = False
        return "the bodies part", "", 0

    @staticmethod
    def slip_rate(step: Step) -> Series:
        """Speed of slip over the ring, positive while it goes on."""
        return [
            step.sign * p - v for p, v in zip(step.series["psi"], step.series["v"], strict=True)
        ]

    def stop(self, sign: int, front: mpf) -> tuple[str, str, int]:
        """Slip ends: keep its trace in the memory; all sticks while loading, the edge slips back
        while unloading.
        """
        level = self.state["b"] ** 2 - sign * self.state["U"]
        offset = [sign * level, ZERO, mpf(-sign)]
        self.memory.append(Memory(sign, front, self.state["b"], ZERO, [ZERO, mpf(1)], offset))
        return (
            ("all sticks", "stick", 0) if self.state["v"] > 0 else ("slip reverses", "slip", -sign)
        )
