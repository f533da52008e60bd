"""What the build of the library changes and reads of numba's private parts; nothing else does.

numba compiles each kernel as soon as another one calls it, optimised and into machine code, again
with all that it calls. For a library this is left out, by PATCHES. A version of numba that lacks a
part breaks the build, so that the versions that the build takes are named in pyproject.toml.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from operator import attrgetter
from typing import Any, NamedTuple
from unittest.mock import patch

import llvmlite.binding as llvm
import numba
from numba import _dynfunc
from numba.core import codegen, cpu, registry
from numba.core.compiler import Flags
from numba.core.dispatcher import _FunctionCompiler  # type: ignore[attr-defined]

from carom.dimensionless.numerics import jit

CODE = attrgetter("library")  # of what numba has compiled


class Patch(NamedTuple):
    """A part of numba, what takes its place during the build, and why."""

    owner: Any
    name: str
    value: Callable[..., Any]
    reason: str


def _nothing(*_: object) -> None:
    """Do nothing."""


def _lay_out(library: Any, module: Any) -> None:
    module.data_layout = library._codegen._data_layout


def _without_wrappers(compiler: Any, flags: Flags) -> Flags:
    flags.no_cpython_wrapper = flags.no_cfunc_wrapper = True
    return flags


def _placeholder(_: Any, library: Any, description: Any, environment: Any) -> Any:
    """Return what numba keeps by kernel and types; nobody calls it."""
    name = description.qualname.rpartition(".")[2]
    module = description.lookup_module()
    return _dynfunc.make_function(module, name, "", 1, environment, (library,))


LIBRARY, ONCE = codegen.CPUCodeLibrary, "all modules are optimised at once, when they are linked"
PATCHES = (
    Patch(jit, "dispatcher", numba.njit(**jit.OPTIONS), "a cache holds code of this processor"),
    Patch(LIBRARY, "_optimize_functions", _lay_out, ONCE),
    Patch(LIBRARY, "_optimize_final_module", _nothing, ONCE),
    Patch(codegen.JITCodeLibrary, "_finalize_specific", _nothing, "nothing is run in this process"),
    Patch(codegen.JITCPUCodegen, "_add_module", _nothing, "no module becomes machine code alone"),
    Patch(cpu.CPUContext, "get_executable", _placeholder, "there is no machine code to be called"),
    Patch(_FunctionCompiler, "_customize_flags", _without_wrappers, "only C calls the library"),
)


@contextmanager
def front_end() -> Iterator[None]:
    """Let numba make and link modules only: they are optimised and made machine code later."""
    with ExitStack() as stack:
        for owner, name, value, _ in PATCHES:
            stack.enter_context(patch.object(owner, name, value))
        yield


def module_of(compiled: Any) -> Any:
    """Return the module of a compiled function, with all that it calls."""
    return CODE(compiled)._get_module_for_linking()


def data_layout() -> Any:
    """Return how data lie in memory, as all modules of a library must have it."""
    return _own()._data_layout


def linked(modules: Iterable[Any]) -> Any:
    """Return a library of these modules."""
    library = _own().create_library("carom")
    for module in modules:
        library._final_module.link_in(module)
    return library


def whole(library: Any) -> Any:
    """Return the one module of a library."""
    return library._final_module


def optimised(library: Any) -> Any:
    """Return the module of a library, optimised as a whole by numba's own passes."""
    library._optimize_functions(library._final_module)
    library._optimize_final_module()
    return library._final_module


def machine() -> Any:
    """Return a target like the one for which numba compiles, for code that may lie anywhere."""
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=_own()._get_host_cpu_name(),
        features=_own()._get_host_cpu_features(),
        opt=3,
        reloc="pic",
        codemodel="default",
    )


def _own() -> Any:
    return registry.cpu_target.target_context.codegen()
