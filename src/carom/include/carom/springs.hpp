// carom/springs.hpp: the tangential force of a contact by springs that remember their slip.
//
// SPDX-License-Identifier: BSD-3-Clause
//
// The contact of spheres is that of independent springs at distances x from its middle, s = x^2/R
// (method of dimensionality reduction; Popov & Hess 2015). At the penetration d a spring is pressed
// by d - s and bears what friction allows, |q| <= d - s, q = (kappa/mu) u its deflection u in units
// in which Coulomb's law has no coefficient:
//
//     F_n = 2 E* int_0^b (d - s) dx,    F_t = 2 E* mu int_0^b q dx,    s(b) = d.
//
// In a step springs that stick follow the bodies, q + dq, and all are cut back to their limit: exact
// on a straight path, off by up to 0.16 friction limits where the load goes round in circles. With
// losses the bodies are Kelvin & Voigt's: what the springs bear is q + tau q', within D - s,
// D = d + tau d'. A spring that is let go recovers freely and is met again where the surfaces meet.
// Springs lie at x = k h; lengths are in units of h^2/R here, so that s = k^2. The integral is their
// sum with a correction at the last spring before the edge (Euler & Maclaurin's): exact where q is
// linear in s. Where q has a corner between springs, as where slip begins, the sum is right in the
// mean while the corner wanders; a rule that is linear between springs would always give too little.
#ifndef CAROM_SPRINGS_HPP
#define CAROM_SPRINGS_HPP

#include "lanes.hpp"

#include "own_names.h"

#include <cmath>
#include <limits>

namespace carom {

/// What a contact remembers besides its springs: losses, energies.
enum Parts : unsigned { elastic = 0, viscous = 1, ledger = 2 };

namespace springs {

/// Springs at s = k^2, whether a spring lies beyond the middle, and a line of zeros but for one.
template <int N, class Real> struct Places {
    Real square[N], aside[N], single[2 * N + 1];
    constexpr Places() : square(), aside(), single() {
        for (int k = 0; k < N; ++k) {
            square[k] = static_cast<Real>(k * k);
            aside[k] = static_cast<Real>(k > 0 ? 1 : 0);
        }
        single[N] = 1;
    }
};

/// Take every other spring: the lattice is twice as wide, and its unit of length four times.
template <int N, class Real> void coarsen(Real (&line)[N]) {
    for (int k = 0; k < N / 2; ++k) line[k] = line[2 * k] / 4;
    for (int k = N / 2; k < N; ++k) line[k] = 0;
}

/// Put a spring between any two of the inner half, linear in s.
template <int N, class Real> void refine(Real (&line)[N]) {
    Real old[N / 2 + 1];
    for (int k = 0; k <= N / 2; ++k) old[k] = line[k];
    for (int k = 0; k < N; ++k) {
        const int j = k / 2;
        const Real part = k % 2 ? (static_cast<Real>(j) + Real(0.25)) / static_cast<Real>(2 * j + 1)
                                : Real(0);
        line[k] = 4 * (old[j] + part * (old[j + 1] - old[j]));
    }
}

/// Lengths beyond it have no squares; no contact is pressed so far.
template <class Real> constexpr double farthest = sizeof(Real) < sizeof(double) ? 4e18 : 4e153;

/// Shorten vectors of which springs take parts up to this share, so that they can be squared.
template <class Real, class T> void shorten(T& x, T& y, const T& share) {
    constexpr double far = farthest<Real>;
    const auto is_far = (x * x + y * y) * (share * share) > far * far;
    if (!any(is_far)) return;
    const T one = T{} + 1.0, all = (larger(x, -x) + larger(y, -y)) * share;
    const T part = is_far ? far / larger(all, one) : one;
    x *= part;
    y *= part;
}

/// Factor that cuts a vector back to a length.
template <class T> T cut(const T& x, const T& y, const T& most) {
    const T square = larger(x * x + y * y, T{} + std::numeric_limits<double>::min());
    return smaller(most * (1.0 / root(square)), T{} + 1.0);
}

}  // namespace springs
}  // namespace carom

#include "own_names.h"

#endif
