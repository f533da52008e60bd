from .many.laws.exact import ReboundLaw as ReboundLaw
from .many.laws.rigid import RoughLaw as RoughLaw, SmoothLaw as SmoothLaw, WaltonLaw as WaltonLaw
from .many.laws.walton_fit import fit_walton as fit_walton
