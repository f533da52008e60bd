"""What has to be compiled before the first answers, where Carom came without its library."""

from collections.abc import Callable
from threading import Condition, Thread
from typing import Any, NamedTuple

from carom.dimensionless.numerics import shared_library
from carom.dimensionless.numerics.kernels import has_numba
from carom.explorer.knobs import NUMBERS
from carom.explorer.overlays import exact_curve, law_curves
from carom.explorer.scenes import scene_of
from carom.explorer.views import LAWS, View
from carom.io.progress import advancing

PATIENCE = 2.0  # s that a question waits for what is not there yet
ELASTIC, LOSSY = View(), View(restitution=0.8)
STEPS: tuple[Callable[[], Any], ...] = (
    lambda: scene_of(ELASTIC),
    lambda: exact_curve(scene_of(ELASTIC)),
    lambda: scene_of(View(given=NUMBERS)),
    lambda: scene_of(LOSSY),
    lambda: exact_curve(scene_of(LOSSY)),
    *(lambda label=label: law_curves(scene_of(ELASTIC), [label]) for label in LAWS),
)


class Need(NamedTuple):
    """How many of the steps answers need, and about how many kernels."""

    steps: int
    kernels: int


OF_ELASTIC, OF_LOSSES, OF_LAWS = Need(3, 126), Need(5, 260), Need(len(STEPS), 310)


class Preparing(RuntimeError):
    """What is asked for is still being compiled; so many percent of it are there."""

    def __init__(self, percent: int) -> None:
        super().__init__(
            "Carom compiles its solver. This happens once, after it was installed without a C "
            f"compiler, and takes up to a minute; {percent} % of what this answer needs is ready."
        )
        self.percent = percent


class Warming:
    """Compiles the solver while the page is served; with the library there is nothing to do."""

    def __init__(self) -> None:
        self._steps = STEPS if shared_library.reason() and has_numba() else ()
        self._done = self.kernels = 0
        self._stopped = False
        self._news = Condition()

    def start(self) -> None:
        """Compile one part after the other, in a thread."""
        if self._steps:
            Thread(target=self._run, name="carom-warming", daemon=True).start()

    def stop(self) -> None:
        """Leave out what has not begun."""
        self._stopped = True

    def check(self, view: View, *, laws: bool = False) -> None:
        """Return once a view can be answered; raise Preparing if that takes long."""
        need = OF_LAWS if laws else OF_LOSSES if view.losses else OF_ELASTIC
        steps = min(need.steps, len(self._steps))
        with self._news:
            if not self._news.wait_for(lambda: self._done >= steps, PATIENCE):
                raise Preparing(min(99, 100 * self.kernels // need.kernels))

    def _run(self) -> None:
        from numba.core import event  # which takes long, and is not needed with the library

        warming = self

        class Counter(event.Listener):  # type: ignore[misc]
            def on_start(self, _: Any) -> None:
                """Say nothing yet."""

            def on_end(self, _: Any) -> None:
                """Count a kernel that is compiled."""
                warming.kernels += 1
                advance(1)

        try:
            with (
                advancing("compiling the solver", OF_LAWS.kernels) as advance,
                event.install_listener("numba:compile", Counter()),
            ):
                for step in self._steps:
                    if self._stopped:
                        return
                    step()
                    self._finish(self._done + 1)
        finally:  # if one has failed, each question tells by itself
            self._finish(len(self._steps))

    def _finish(self, done: int) -> None:
        with self._news:
            self._done = done
            self._news.notify_all()
