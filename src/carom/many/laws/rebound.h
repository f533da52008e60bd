/* The exact oblique impact of spheres: psi_2(psi_1), to $error,
 * at chi = $chis.
 *
 * Written by Carom $version; its licence, BSD 3-Clause, is that of this file.
 *
 * psi = kappa V_x / (mu V_1) is the tangential velocity of the contact point over that of approach,
 * with kappa = G* / E*, chi = (kappa / 2)(m_n / m_t). After the impact
 *
 *     V_x' = (mu V_1 / kappa) psi_2,    J_x = m_t (V_x' - V_x),    V_n' = -e V_n.
 *
 * psi_2 = r(|psi_1|) psi_1, r a polynomial on each panel; psi_2 = psi_1 -+ 2 chi (1 + e) in gross
 * slip throughout (Maw, Barber & Fawcett 1976; Barber 1979); e < 1 of a Kelvin-Voigt solid, viscous
 * in shear as in compression, or of a plate that gives way (Zener 1941), where it is e at one
 * lambda = m_n V_1/(8 sqrt(D rho h) d_max). C99 or C++, nothing to link.
 */
#ifndef $guard
#define $guard
$functions
#endif
