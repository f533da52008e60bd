"""Object code of kernels, for a shared library: numba's front end, then LLVM, once for all of them.

numba compiles each kernel as soon as another one calls it, optimised and into machine code, again
with all that it calls. Here this is left out: modules are only linked, optimised once as a whole by
numba's own passes, and written as an object file. That is four times faster and gives the same
bits: there are no fast-math flags that would let LLVM change results.
"""

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from importlib import import_module
from operator import attrgetter
from pathlib import Path
from typing import Any
from unittest.mock import patch

import llvmlite.binding as llvm
import numba
import numpy as np
from llvmlite import ir
from numba import _dynfunc, carray, types
from numba.core import codegen, cpu, registry
from numba.core.compiler import Flags
from numba.core.compiler_lock import global_compiler_lock
from numba.core.dispatcher import _FunctionCompiler  # type: ignore[attr-defined]

from carom.dimensionless.numerics import jit
from carom.dimensionless.numerics.arrays import ArrayType
from carom.dimensionless.numerics.jit import OPTIONS
from carom.dimensionless.numerics.kernels import ENTRIES, Kernel
from carom.dimensionless.numerics.signatures import Group, Signature

Library = codegen.CPUCodeLibrary
CODE = attrgetter("library")  # of what numba has compiled
NUMBERS = {float: types.float64, int: types.int64, bool: types.int64}
C_LIBRARY = """
    memcpy memset memmove sqrt cbrt pow exp log log1p expm1 hypot sin cos tan asin acos atan atan2
    sinh cosh tanh asinh acosh atanh floor ceil trunc round fabs fmod fmin fmax ldexp frexp
"""
ALLOWED = frozenset(C_LIBRARY.split())  # which a kernel may call

# Arrays that come from outside are not counted; this takes the place of what numba brings.
NO_COUNTING = """
define void @NRT_incref(i8* %x) alwaysinline { ret void }
define void @NRT_decref(i8* %x) alwaysinline { ret void }
"""


@contextmanager
def front_end() -> Iterator[None]:
    """Let numba make and link modules only: they are optimised and made machine code later."""
    changes = (
        (jit, "dispatcher", numba.njit(**OPTIONS)),  # not cached
        (Library, "_optimize_functions", _lay_out),
        (Library, "_optimize_final_module", _nothing),
        (codegen.JITCodeLibrary, "_finalize_specific", _nothing),
        (codegen.JITCPUCodegen, "_add_module", _nothing),
        (cpu.CPUContext, "get_executable", _placeholder),
        (_FunctionCompiler, "_customize_flags", _without_wrappers),
    )
    with ExitStack() as stack:
        for owner, name, value in changes:
            stack.enter_context(patch.object(owner, name, value))
        yield


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


@global_compiler_lock  # type: ignore[untyped-decorator]
def object_code(entries: Iterable[Kernel[..., Any]]) -> bytes:
    """Return an object file of entry points, which needs nothing but the C library.

    Raises RuntimeError for kernels that need more: that allocate memory, or raise.
    """
    with front_end():
        modules = {
            name: _module(name, kernel.dispatcher, signature)
            for kernel in entries
            for name, signature in kernel.signatures().items()
        }
    whole = registry.cpu_target.target_context.codegen().create_library("carom")
    whole._final_module.link_in(llvm.parse_assembly(NO_COUNTING))
    for module in modules.values():
        whole._final_module.link_in(module)
    _hide_all_but(whole._final_module, set(modules))
    whole._optimize_functions(whole._final_module)
    whole._optimize_final_module()
    module = whole._final_module
    needed = {each.name for each in module.functions if each.is_declaration}
    foreign = {name for name in needed if not name.startswith("llvm.")} - ALLOWED
    if foreign:
        raise RuntimeError(f"kernels of the library need {', '.join(sorted(foreign))}")
    return bytes(_machine().emit_object(module))


def _hide_all_but(module: Any, names: set[str]) -> None:
    for each in (*module.functions, *module.global_variables):
        if not each.is_declaration and each.name not in names:
            each.linkage = "internal"


def _machine() -> Any:
    """Return a target like the one for which numba compiles, for code that may lie anywhere."""
    own = registry.cpu_target.target_context.codegen()
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=own._get_host_cpu_name(),
        features=own._get_host_cpu_features(),
        opt=3,
        reloc="pic",
        codemodel="default",
    )


def _module(name: str, compiled: Any, signature: Signature) -> Any:
    """Return the module of a C function that calls a kernel, with all that it calls."""
    arguments = tuple(_arguments(signature))
    wrapper = numba.njit(**OPTIONS)(_wrapper(compiled, signature))
    wrapper.compile(arguments)
    found = wrapper.overloads[arguments]
    module = CODE(found)._get_module_for_linking().clone()
    module.link_in(_c_function(name, found, arguments))
    return module


def _c_function(name: str, found: Any, arguments: tuple[Any, ...]) -> Any:
    """Return the module of a C function of a block of arguments; not 0 if the kernel has raised."""
    kind = found.target_context.call_conv.get_function_type(types.none, arguments)
    module = ir.Module(name)
    module.data_layout = CODE(found)._codegen._data_layout
    inner = ir.Function(module, kind, found.fndesc.llvm_func_name)
    word = ir.IntType(64)
    outer = ir.Function(module, ir.FunctionType(ir.IntType(32), [word.as_pointer()]), name)
    builder = ir.IRBuilder(outer.append_basic_block())
    given = [builder.alloca(each.pointee) for each in kind.args[:2]]
    for i, (wanted, each) in enumerate(zip(arguments, kind.args[2:], strict=True)):
        place = builder.gep(outer.args[0], [word(i)])
        if isinstance(wanted, types.CPointer):  # a result, which lies in the block itself
            given.append(builder.bitcast(place, each))
        elif wanted == types.voidptr:
            given.append(builder.inttoptr(builder.load(place), each))
        else:
            given.append(builder.load(builder.bitcast(place, each.as_pointer())))
    builder.ret(builder.call(inner, given))
    return llvm.parse_assembly(str(module))


def _arguments(signature: Signature) -> list[Any]:
    found: list[Any] = []
    for kind in signature.leaves():
        if isinstance(kind, ArrayType):
            found += [types.voidptr, *[types.int64] * kind.ndim]
        else:
            found.append(NUMBERS[kind])
    return found + [types.CPointer(NUMBERS[kind]) for kind in signature.results]


def _wrapper(compiled: Any, signature: Signature) -> Callable[..., None]:
    """Return a function of addresses, shapes and numbers that calls a kernel."""
    names: dict[str, Any] = {"__name__": "carom.wrapper", "kernel": compiled, "carray": carray}
    taken: list[str] = []
    given = [_expression(kind, names, taken) for kind in signature.parameters.values()]
    outs = [f"out{i}" for i in range(len(signature.results))]
    values = ["found"] if signature.single else [f"found[{i}]" for i in range(len(outs))]
    lines = [
        f"def wrapper({', '.join((*taken, *outs))}):",
        f"    found = kernel({', '.join(given)})",
        *(f"    carray({out}, 1)[0] = {value}" for out, value in zip(outs, values, strict=False)),
    ]
    exec("\n".join(lines), names)
    return names["wrapper"]  # type: ignore[no-any-return]


def _expression(kind: Any, names: dict[str, Any], taken: list[str]) -> str:
    """Return the text of an argument of a kernel; its parts are added to what is taken."""

    def new() -> str:
        taken.append(f"x{len(taken)}")
        return taken[-1]

    if isinstance(kind, Group):
        inner = ", ".join(_expression(each, names, taken) for each in kind.kinds)
        if kind.make is tuple:
            return f"({inner},)"
        names[kind.make.__name__] = kind.make
        return f"{kind.make.__name__}({inner})"
    if isinstance(kind, ArrayType):
        names[kind.dtype.name] = np.dtype(kind.dtype)
        address, *shape = (new() for _ in range(1 + kind.ndim))
        return f"carray({address}, ({', '.join(shape)},), {kind.dtype.name})"
    return f"({new()} != 0)" if kind is bool else new()


def main(target: str, *modules: str) -> None:
    """Write the object file of the entry points of some modules."""
    for name in modules:
        import_module(name)
    Path(target).write_bytes(object_code(each for each in ENTRIES if each.__module__ in modules))


if __name__ == "__main__":
    main(*sys.argv[1:])
