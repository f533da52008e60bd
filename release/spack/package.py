# For Spack, as py-carom. Never run: copy it to a repository of packages of yours, and try it there.
# ruff: noqa: D100, F403, F405
from spack.package import *


class PyCarom(PythonPackage):
    """The exact oblique impact of elastic spheres: rebound, stick and slip."""

    pypi = "carom/carom-0.3.0.tar.gz"
    license("BSD-3-Clause AND BSD-2-Clause AND GPL-2.0-only")

    version("0.3.0")  # with the sha256 of the archive, once it is on PyPI

    depends_on("c", type="build")
    depends_on("python@3.11:", type=("build", "run"))
    depends_on("py-hatchling", type="build")
    depends_on("py-numba@0.61:0.68", type="build")
    depends_on("py-numpy@2.0:", type=("build", "run"))
    depends_on("py-lazy-loader@0.4:", type=("build", "run"))
    depends_on("py-array-api-compat@1.11:", type=("build", "run"))
    depends_on("py-scipy@1.14:", type="run")
    depends_on("py-xarray@2025.6.1:", type="run")
    depends_on("py-h5netcdf@1.3:", type="run")
    depends_on("py-h5py@3.11:", type="run")
    depends_on("py-pandas@2.2.2:", type="run")
    depends_on("py-matplotlib@3.9:", type="run")
    depends_on("py-contourpy@1.2.1:", type="run")
    depends_on("pil@10:", type="run")
    depends_on("py-pint@0.24.4:", type="run")
    depends_on("py-typer@0.29:", type="run")
    depends_on("py-rich@13:", type="run")
