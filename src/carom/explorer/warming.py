"""What has to be compiled before the first answers, where Carom came without its library."""

from collections.abc import Callable
from threading import Condition, Thread
from typing import Any

from carom.dimensionless.numerics import shared_library
from carom.dimensionless.numerics.kernels import has_numba
from carom.explorer.overlays import exact_curve, law_curves
from carom.explorer.scenes import scene_of
from carom.explorer.views import LAWS, NUMBERS, View
from carom.io.progress import advancing

PATIENCE_SECONDS = 2.0  # that a question waits for what is not there yet
ELASTIC, LOSSY, PLATE = View(), View(restitution=0.8), View(thickness=3.0)
STEPS: tuple[Callable[[], Any], ...] = (
    lambda: scene_of(ELASTIC),
    lambda: exact_curve(scene_of(ELASTIC)),
    lambda: scene_of(View(given=NUMBERS)),
    lambda: scene_of(LOSSY),
    lambda: exact_curve(scene_of(LOSSY)),
    lambda: exact_curve(scene_of(PLATE)),
    *(lambda label=label: law_curves(scene_of(ELASTIC), [label]) for label in LAWS),
)


OF_ELASTIC, OF_LOSSES, OF_LAWS = 3, 6, len(STEPS)  # steps that answers need


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
        self._done = 0
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
        needed = OF_LAWS if laws else OF_LOSSES if view.is_lossy else OF_ELASTIC
        needed = min(needed, len(self._steps))
        with self._news:
            if not self._news.wait_for(lambda: self._done >= needed, PATIENCE_SECONDS):
                raise Preparing(100 * self._done // needed)

    def _run(self) -> None:
        try:
            with advancing("compiling the solver", len(self._steps)) as advance:
                for done, step in enumerate(self._steps, 1):
                    if self._stopped:
                        return
                    step()
                    advance(1)
                    self._finish(done)
        finally:  # if one has failed, each question tells by itself
            self._finish(len(self._steps))

    def _finish(self, done: int) -> None:
        with self._news:
            self._done = done
            self._news.notify_all()
