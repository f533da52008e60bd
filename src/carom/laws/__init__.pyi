from .exact import ReboundLaw as ReboundLaw
from .rigid import RoughLaw as RoughLaw, SmoothLaw as SmoothLaw, WaltonLaw as WaltonLaw
from .walton_fit import fit_walton as fit_walton
