"""Symbol, unit and meaning of every quantity, from which labels and attributes are made."""

from typing import NamedTuple

from carom.quantities.prefixes import DIGITS, span, text


class Quantity(NamedTuple):
    """An entry of the glossary: mathematical symbol, SI unit, meaning."""

    symbol: str
    unit: str
    meaning: str

    def label(self) -> str:
        """Return the label of an axis."""
        unit = "" if self.unit == "1" else f" ({self.unit})"
        return f"{self.meaning}, {self.symbol}{unit}"

    def text(self, value: float, digits: int = DIGITS) -> str:
        """Return a value with its unit, to read; a dash for what is no number.

        >>> from carom.quantities.glossary import GLOSSARY
        >>> GLOSSARY["radius"].text(0.000187666), GLOSSARY["angle"].text(0.5)
        ('187.666 µm', '28.6479 deg (0.5 rad)')
        """
        return text(value, self.unit, digits)

    def span(self, low: float, high: float, digits: int = DIGITS) -> str:
        """Return from where to where values go, in one unit, to read.

        >>> from carom.quantities.glossary import GLOSSARY
        >>> GLOSSARY["normal_force"].span(0.0, 845.996)
        '0 to 845.996 N'
        """
        return span(low, high, self.unit, digits)


GLOSSARY = {
    # what is given
    "radius": Quantity("$R$", "m", "radius"),
    "diameter": Quantity("$2R$", "m", "diameter"),
    "inner_radius": Quantity("$R_i$", "m", "inner radius of a hollow sphere"),
    "gyration_radius": Quantity("$K$", "m", "radius of gyration about the centre"),
    "young": Quantity("$E$", "Pa", "Young's modulus"),
    "poisson": Quantity(r"$\nu$", "1", "Poisson's ratio"),
    "density": Quantity(r"$\rho$", "kg/m^3", "density"),
    "yield_strength": Quantity("$Y$", "Pa", "yield strength"),
    "tensile_strength": Quantity(r"$\sigma_t$", "Pa", "tensile strength"),
    "fracture_toughness": Quantity("$K_c$", "Pa m^0.5", "fracture toughness"),
    "flaw_size": Quantity("$c$", "m", "depth of the flaws in the surface"),
    "friction": Quantity(r"$\mu$", "1", "coefficient of friction"),
    "speed": Quantity("$V$", "m/s", "speed of approach of the centres"),
    "angle": Quantity(r"$\theta$", "rad", "angle of incidence from the normal"),
    "normal_speed": Quantity("$V_1$", "m/s", "normal speed of approach"),
    "tangential_speed": Quantity("$v_t$", "m/s", "tangential speed of the centres"),
    "spin": Quantity(r"$\omega$", "rad/s", "spin of the first body"),
    "spin2": Quantity(r"$\omega_2$", "rad/s", "spin of the second body"),
    "normal_spin": Quantity(
        r"$\omega_n$", "rad/s", "spin about the line of impact, of the first body less the second"
    ),
    # of a pair
    "effective_modulus": Quantity("$E^*$", "Pa", "effective modulus of both bodies"),
    "effective_shear_modulus": Quantity("$G^*$", "Pa", "effective shear modulus of both bodies"),
    "effective_radius": Quantity("$R^*$", "m", "effective radius of both bodies"),
    "normal_mass": Quantity("$m_n$", "kg", "effective mass in the normal direction"),
    "tangential_mass": Quantity("$m_t$", "kg", "effective mass of the contact point, tangentially"),
    "kappa": Quantity(r"$\kappa$", "1", "ratio of tangential to normal contact stiffness"),
    "chi": Quantity(r"$\chi$", "1", "ratio of inertia to stiffness, tangential against normal"),
    "dundurs_beta": Quantity(r"$\beta$", "1", "Dundurs' second parameter"),
    # dimensionless impact
    "psi_in": Quantity(r"$\psi_1$", "1", "dimensionless velocity of the contact point before"),
    "psi_out": Quantity(r"$\psi_2$", "1", "dimensionless velocity of the contact point after"),
    "contact_restitution": Quantity(
        "$e_c$", "1", "tangential velocity of the contact point, after to before"
    ),
    "tangential_restitution": Quantity(
        "$e_t$", "1", "tangential velocity of the centres, after to before"
    ),
    "border_psi": Quantity(r"$\psi_1$", "1", "psi_1 of the points of borders between regimes"),
    "border_chi": Quantity(r"$\chi$", "1", "chi of the points of borders between regimes"),
    "border_number": Quantity("$n$", "1", "number of the border that a point belongs to"),
    "outline_psi": Quantity(r"$\psi_1$", "1", "psi_1 of the points of outlines of regimes"),
    "outline_chi": Quantity(r"$\chi$", "1", "chi of the points of outlines of regimes"),
    "outline_number": Quantity("$n$", "1", "number of the outline that a point belongs to"),
    "outline_region": Quantity("$n$", "1", "number of the region that an outline is of"),
    "border_tolerance": Quantity(
        r"$\epsilon$", "1", "largest error of psi_1 or chi on a border, a share of it beyond 1"
    ),
    "time_limit": Quantity("$t_{max}$", "s", "time after which a program is killed"),
    "tolerance": Quantity(r"$\epsilon$", "1", "largest error that is allowed"),
    "restitution": Quantity("$e$", "1", "normal restitution that a law is made for"),
    "stiffness_ratio": Quantity("$k_t/k_n$", "1", "ratio of tangential to normal spring stiffness"),
    "stiffness": Quantity(
        "$k_t/(2 G^* b)$", "1", "tangential stiffness in units of that of elastic bodies"
    ),
    "tangential_damping": Quantity(
        "$c_t/c_n$", "1", "tangential damping in units of the normal one"
    ),
    "drop_height": Quantity("$h$", "m", "height from which the first body falls"),
    "rebound_height": Quantity("$h'$", "m", "height to which the first body comes back"),
    "normal_restitution": Quantity("$e$", "1", "normal velocity, after to before"),
    "beta_0": Quantity(r"$\beta_0$", "1", "$-V_x'/V_x$ of the contact point where it sticks"),
    "contact_beta": Quantity(
        r"$\beta$", "1", "tangential restitution of the contact point, $-V_x'/V_x$"
    ),
    "contact_angle": Quantity(
        r"$\theta_c$", "rad", "angle of incidence of the contact point, from the normal"
    ),
    "contact_rebound_angle": Quantity(
        r"$\theta_c'$", "rad", "angle of rebound of the contact point, from the normal"
    ),
    "spin_offset": Quantity(r"$\delta\omega$", "rad/s", "initial spin that was not intended"),
    "loss_time": Quantity(r"$\tau$", "s", "retardation time of a Kelvin-Voigt solid"),
    "relaxation_time": Quantity(
        r"$\tau_r$", "s", "relaxation time of a standard linear solid, at constant strain"
    ),
    "modulus_ratio": Quantity(
        "$E_0/E$", "1", "instantaneous over relaxed modulus of a standard linear solid"
    ),
    "yield_velocity": Quantity("$V_y$", "m/s", "normal velocity above which a body yields"),
    "lost_energy": Quantity("$W_n$", "J", "energy lost in the normal motion"),
    "shear_lost_energy": Quantity("$W_s$", "J", "energy lost to viscosity in shear"),
    "impulse_ratio": Quantity("$J_t/J_n$", "1", "tangential impulse to normal impulse"),
    "normal_speed_out": Quantity("$V_1'$", "m/s", "normal speed of the centres after"),
    "tangential_impulse": Quantity("$J_t$", "N s", "impulse of the tangential force, against $x$"),
    "contact_velocity_out": Quantity(
        "$V_x'$", "m/s", "tangential velocity of the contact point after"
    ),
    # a history
    "time": Quantity("$t$", "s", "time since the first touch"),
    "penetration": Quantity("$d$", "m", "normal approach of the bodies"),
    "normal_velocity": Quantity("$V_z$", "m/s", "normal velocity, positive while approaching"),
    "contact_velocity": Quantity("$V_x$", "m/s", "tangential velocity of the contact point"),
    "displacement": Quantity("$U$", "m", "tangential displacement of the bodies since the start"),
    "normal_force": Quantity("$F_z$", "N", "normal force"),
    "tangential_force": Quantity("$F_x$", "N", "tangential force, positive against $V_x$"),
    "frictional_moment": Quantity(
        "$M$", "N m", "moment of friction about the line of impact, against the spin"
    ),
    "contact_velocity_across": Quantity(
        "$V_y$", "m/s", "velocity of the contact point across the plane of incidence"
    ),
    "normal_spin_kinetic_energy": Quantity(
        r"$T_{\omega n}$", "J", "kinetic energy of the relative spin about the line of impact"
    ),
    "contact_radius": Quantity("$b$", "m", "radius of the contact"),
    "stick_radius": Quantity("$a$", "m", "radius of the stick zone"),
    "normal_kinetic_energy": Quantity("$T_n$", "J", "kinetic energy of the normal motion"),
    "tangential_kinetic_energy": Quantity(
        "$T_t$", "J", "kinetic energy of the tangential motion of the centres"
    ),
    "normal_elastic_energy": Quantity("$E_n$", "J", "elastic energy of normal deformation"),
    "tangential_elastic_energy": Quantity("$E_t$", "J", "elastic energy of tangential deformation"),
    "normal_loss": Quantity("$W_n$", "J", "energy lost in the normal motion so far"),
    "shear_loss": Quantity("$W_s$", "J", "energy lost to viscosity in shear so far"),
    "frictional_work": Quantity("$W$", "J", "energy dissipated by slip so far"),
    "spin_kinetic_energy": Quantity(r"$T_\omega$", "J", "kinetic energy of the spins"),
    "contact_kinetic_energy": Quantity(
        "$T_c$", "J", "kinetic energy of the contact point, on which friction can act"
    ),
    "phase_sign": Quantity(r"$\sigma$", "1", "sign of slip, 0 in stick"),
    "phase_start": Quantity("$t_s$", "s", "start of the phase"),
    "phase_end": Quantity("$t_e$", "s", "end of the phase"),
    "phase_slip_angle_max": Quantity(
        r"$\beta_{max}$", "rad", "largest angle between slip and $x$ in the phase"
    ),
    "phase_slip_angle_mean": Quantity(
        r"$\bar\beta$", "rad", "angle between slip and $x$, mean weighted with frictional work"
    ),
    "slip_angle": Quantity(r"$\beta$", "rad", "angle between slip and $x$, mean over the work"),
    "slip_angle_max": Quantity(r"$\beta_{max}$", "rad", "largest angle between slip and $x$"),
    # inside the contact
    "x": Quantity("$x$", "m", "position along the tangential motion"),
    "y": Quantity("$y$", "m", "position across the tangential motion"),
    "z": Quantity("$z$", "m", "depth below the surface"),
    "distance": Quantity("$r$", "m", "distance from the centre of the contact"),
    "pressure": Quantity("$p$", "Pa", "contact pressure"),
    "traction_x": Quantity("$f_x$", "Pa", "tangential traction, positive against $V_x$"),
    "traction_y": Quantity("$f_y$", "Pa", "tangential traction across the motion"),
    "friction_limit": Quantity(r"$\mu p$", "Pa", "largest traction that friction allows"),
    "memory_g": Quantity("$g$", "1", "memory, $-dq/ds$"),
    "memory_q": Quantity("$q$", "m", "deflection of tangential spring"),
    "memory_limit": Quantity(r"$q_{max}$", "m", "largest deflection that friction allows"),
    "displacement_x": Quantity("$u_x$", "m", "surface displacement, relative, along $x$"),
    "displacement_y": Quantity("$u_y$", "m", "surface displacement, relative, along $y$"),
    "displacement_z": Quantity("$u_z$", "m", "surface displacement, relative, along $z$"),
    "slip_x": Quantity("$w_x$", "m", "slip along $x$, since the points met"),
    "slip_y": Quantity("$w_y$", "m", "slip along $y$, since the points met"),
    "slip_velocity_x": Quantity(r"$\dot w_x$", "m/s", "slip velocity along $x$"),
    "slip_velocity_y": Quantity(r"$\dot w_y$", "m/s", "slip velocity along $y$"),
    "friction_work": Quantity("$W_A$", "J/m^2", "work of friction per area"),
    "mean_friction_work": Quantity(
        r"$\bar W_A$", "J/m^2", "work of friction per area, mean around the centre"
    ),
    "max_friction_work": Quantity(r"$\max W_A$", "J/m^2", "largest work of friction per area"),
    "max_wear_radius": Quantity("$r_w$", "m", "distance from the centre at which wear is largest"),
    "work_error": Quantity(
        r"$\delta W$", "1", "relative error of the work per area, summed over the contact"
    ),
    "wear_coefficient": Quantity(
        "$k$", "m^2/N", "coefficient of wear, volume over load and sliding distance"
    ),
    "wear_depth": Quantity("$h_w$", "m", "depth of wear"),
    "mean_wear_depth": Quantity(r"$\bar h_w$", "m", "depth of wear, mean around the centre"),
    "max_wear_depth": Quantity(r"$\max h_w$", "m", "largest depth of wear"),
    "worn_volume": Quantity("$V_w$", "m^3", "volume that wear removes"),
    "counts": Quantity("$N$", "1", "number of times that the impact happens"),
    "area": Quantity("$A$", "m^2", "area over which impacts are spread"),
    "total_friction_work": Quantity(r"$\sum W$", "J", "work of friction of all impacts"),
    "total_worn_volume": Quantity(r"$\sum V_w$", "m^3", "volume that all impacts remove"),
    "spread_friction_work": Quantity(
        r"$\sum W/A$", "J/m^2", "work of friction per area, spread evenly"
    ),
    "spread_wear_depth": Quantity(r"$\sum V_w/A$", "m", "depth of wear, spread evenly"),
    "unsolved_impacts": Quantity("$N_0$", "1", "number of impacts that are not solved, left out"),
    "sigma_xx": Quantity(r"$\sigma_{xx}$", "Pa", "stress along x, tension positive"),
    "sigma_yy": Quantity(r"$\sigma_{yy}$", "Pa", "stress along y, tension positive"),
    "sigma_zz": Quantity(r"$\sigma_{zz}$", "Pa", "stress along the depth, tension positive"),
    "sigma_xy": Quantity(r"$\sigma_{xy}$", "Pa", "shear stress in planes parallel to the surface"),
    "sigma_xz": Quantity(r"$\sigma_{xz}$", "Pa", "shear stress in planes across y"),
    "sigma_yz": Quantity(r"$\sigma_{yz}$", "Pa", "shear stress in planes across x"),
    "principal_1": Quantity(r"$\sigma_1$", "Pa", "largest principal stress"),
    "principal_2": Quantity(r"$\sigma_2$", "Pa", "middle principal stress"),
    "principal_3": Quantity(r"$\sigma_3$", "Pa", "smallest principal stress"),
    "von_mises": Quantity(r"$\sigma_M$", "Pa", "von Mises stress"),
    "max_shear": Quantity(r"$\tau_{max}$", "Pa", "largest shear stress at the point"),
    "max_von_mises": Quantity(r"$\max\sigma_M$", "Pa", "largest von Mises stress in the body"),
    "max_von_mises_x": Quantity("$x_M$", "m", "where the von Mises stress is largest, along x"),
    "max_von_mises_y": Quantity("$y_M$", "m", "where the von Mises stress is largest, along y"),
    "max_von_mises_z": Quantity("$z_M$", "m", "depth where the von Mises stress is largest"),
    "max_tension": Quantity(r"$\max\sigma_1$", "Pa", "largest tensile stress on the surface"),
    "max_tension_x": Quantity("$x_t$", "m", "where the surface tension is largest, along x"),
    "max_tension_y": Quantity("$y_t$", "m", "where the surface tension is largest, along y"),
    "max_tension_z": Quantity("$z_t$", "m", "depth of the largest surface tension, which is zero"),
    # of the bodies through a whole impact
    "peak_von_mises": Quantity(r"$\hat\sigma_M$", "Pa", "largest von Mises stress of the impact"),
    "peak_shear": Quantity(r"$\hat\tau$", "Pa", "largest shear stress of the impact"),
    "peak_tension": Quantity(r"$\hat\sigma_1$", "Pa", "largest tensile stress of the impact"),
    "searched_depth": Quantity("$z_0$", "m", "depth below which largest stresses are searched for"),
    "stress_intensity": Quantity("$K$", "Pa m^0.5", "largest stress intensity at a flaw"),
    "critical_flaw": Quantity("$c_K$", "m", "depth of the flaw with the largest stress intensity"),
    "yield_ratio": Quantity(r"$\hat\sigma_M/Y$", "1", "largest von Mises stress to yield strength"),
    "tension_ratio": Quantity(
        r"$\hat\sigma_1/\sigma_t$", "1", "largest tensile stress to tensile strength"
    ),
    "toughness_ratio": Quantity("$K/K_c$", "1", "largest stress intensity to fracture toughness"),
    "yield_speed": Quantity("$V_Y$", "m/s", "speed above which the body yields"),
    "tensile_speed": Quantity("$V_t$", "m/s", "speed above which the tensile strength is exceeded"),
    "crack_speed": Quantity("$V_c$", "m/s", "speed above which flaws in the surface crack"),
    # a result
    "duration": Quantity("$t_c$", "s", "duration of the contact"),
    "max_penetration": Quantity("$d_{max}$", "m", "largest penetration"),
    "max_force": Quantity("$P_{max}$", "N", "largest normal force"),
    "max_radius": Quantity("$a_{max}$", "m", "largest radius of the contact"),
    "max_pressure": Quantity("$p_0$", "Pa", "largest contact pressure"),
    "rebound_speed": Quantity("$V'$", "m/s", "speed of the centres after the impact"),
    "rebound_angle": Quantity(
        r"$\theta'$", "rad", "angle of rebound of the centres, from the normal"
    ),
    "tangential_speed_out": Quantity("$v_t'$", "m/s", "tangential speed of the centres after"),
    "spin_out": Quantity(r"$\omega'$", "rad/s", "spin of the first body after"),
    "spin2_out": Quantity(r"$\omega_2'$", "rad/s", "spin of the second body after"),
    "normal_spin_out": Quantity(
        r"$\omega_n'$", "rad/s", "spin about the line of impact after, first body less the second"
    ),
    "dissipated_energy": Quantity("$W$", "J", "energy lost to friction"),
    "psi_out_error": Quantity(
        r"$\delta\psi_2$", "1", "error of the rebound by grid and time steps"
    ),
    "energy_error": Quantity(
        r"$\delta E$", "1", "largest relative change of the sum of all energies"
    ),
    # spectra of forces
    "frequency": Quantity("$f$", "Hz", "frequency"),
    "max_frequency": Quantity("$f_{max}$", "Hz", "highest frequency"),
    "normal_spectrum": Quantity(r"$|\hat F_z|$", "N s", "amplitude spectrum of the normal force"),
    "normal_spectrum_real": Quantity(
        r"$\mathrm{Re}\,\hat F_z$", "N s", "real part of the spectrum of the normal force"
    ),
    "normal_spectrum_imag": Quantity(
        r"$\mathrm{Im}\,\hat F_z$", "N s", "imaginary part of the spectrum of the normal force"
    ),
    "tangential_spectrum": Quantity(
        r"$|\hat F_x|$", "N s", "amplitude spectrum of the tangential force"
    ),
    "tangential_spectrum_real": Quantity(
        r"$\mathrm{Re}\,\hat F_x$", "N s", "real part of the spectrum of the tangential force"
    ),
    "tangential_spectrum_imag": Quantity(
        r"$\mathrm{Im}\,\hat F_x$", "N s", "imaginary part of the spectrum of the tangential force"
    ),
    "moment_spectrum": Quantity(
        r"$R|\hat F_x|$", "N m s", "amplitude spectrum of the moment about the first centre"
    ),
    "moment_spectrum_real": Quantity(
        r"$R\,\mathrm{Re}\,\hat F_x$",
        "N m s",
        "real part of the spectrum of the moment about the first centre",
    ),
    "moment_spectrum_imag": Quantity(
        r"$R\,\mathrm{Im}\,\hat F_x$",
        "N m s",
        "imaginary part of the spectrum of the moment about the first centre",
    ),
    "normal_impulse": Quantity("$J_n$", "N s", "impulse of the normal force"),
    "normal_corner_frequency": Quantity(
        r"$f_{-3\,dB}$", "Hz", "frequency at which the normal spectrum has fallen by 3 dB"
    ),
    "normal_half_frequency": Quantity(
        r"$f_{-6\,dB}$", "Hz", "frequency at which the normal spectrum has fallen by 6 dB"
    ),
    "normal_notch_frequency": Quantity(
        "$f_0$", "Hz", "frequency of the first minimum of the normal spectrum"
    ),
    "tangential_peak_frequency": Quantity(
        "$f_{p,x}$", "Hz", "frequency at which the tangential spectrum is largest"
    ),
    "tangential_corner_frequency": Quantity(
        r"$f_{-3\,dB,x}$", "Hz", "frequency beyond the tangential peak at 3 dB below it"
    ),
    "tangential_half_frequency": Quantity(
        r"$f_{-6\,dB,x}$", "Hz", "frequency beyond the tangential peak at 6 dB below it"
    ),
}
NEEDED_STRENGTHS: dict[str, tuple[str, ...]] = {  # of a body, for what a sweep tells of it
    "peak_von_mises": (),
    "peak_shear": (),
    "peak_tension": (),
    "stress_intensity": ("flaw_size",),
    "yield_speed": ("yield_strength",),
    "tensile_speed": ("tensile_strength",),
    "crack_speed": ("fracture_toughness", "flaw_size"),
}
for _name in NEEDED_STRENGTHS:
    for _body in ("first", "second"):
        _known = GLOSSARY[_name]
        GLOSSARY[f"{_name}_{_body}"] = _known._replace(meaning=f"{_known.meaning}, {_body} body")
PEAKS = {  # of an impact: what they are of, the index of their symbol
    "peak_von_mises": ("von Mises stress is largest", "M"),
    "peak_shear": ("shear stress is largest", r"\tau"),
    "peak_tension": ("tensile stress is largest", "1"),
    "stress_intensity": ("stress intensity is largest", "K"),
}
for _name, (_largest, _index) in PEAKS.items():
    for _axis, _unit, _where in (
        ("x", "m", "where the {0}, along x"),
        ("y", "m", "where the {0}, along y"),
        ("z", "m", "depth where the {0}"),
        ("time", "s", "time at which the {0}"),
    ):
        _symbol = f"${_axis[0]}_{{{_index}}}$"
        GLOSSARY[f"{_name}_{_axis}"] = Quantity(_symbol, _unit, _where.format(_largest))
