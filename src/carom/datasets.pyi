from .lab.datasets.shipped import (
    load as load,
    names as names,
    parameters as parameters,
    path as path,
    table as table,
)
