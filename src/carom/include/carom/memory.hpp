// carom/memory.hpp: what a contact remembers, and the lattice on which its springs stand.
//
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CAROM_MEMORY_HPP
#define CAROM_MEMORY_HPP

#include "pair.hpp"
#include "springs.hpp"

#include "own_names.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace springs {
template <int N, class Real, bool> struct Recovery {};
template <int N, class Real> struct Recovery<N, Real, true> {
    Real pressed[N];  ///< how far springs are pressed that were let go
    Real approach, slide_x, slide_y;  ///< velocities in the middle of the step before
    Real damped, damped_x, damped_y;  ///< what dashpots took of velocities in half of it
    Real steps, fade;  ///< in retardation times, and what fades in it: it is seldom another
};
template <class Real, bool> struct Forces {};
template <class Real> struct Forces<Real, true> {
    Real normal, shear_x, shear_y;  ///< of the step before
};
template <class Real, unsigned> struct Ledger {};
template <class Real> struct Ledger<Real, ledger> {
    Real stored;  ///< work done on the contact that is not lost
};
template <class Real> struct Ledger<Real, viscous | ledger> : Ledger<Real, ledger> {
    Real power;  ///< that dashpots took in compression in the step before
    Real limit, drag_x, drag_y;  ///< D and tau q' then
};
}  // namespace springs

/// The memory of a contact: N springs; plain numbers, all zeros while the bodies are apart.
template <int N = 16, class Real = double, unsigned P = elastic>
struct Contact : springs::Recovery<N, Real, (P & viscous) != 0>,
                 springs::Forces<Real, P != elastic>,
                 springs::Ledger<Real, P> {
    static_assert(N >= 8 && N <= 4096 && N % 4 == 0, "8 to 4096 springs, a multiple of 4");
    Real spacing;  ///< of the springs; 0 while the bodies are apart
    Real edge;     ///< s at the edge of the contact, in spacing^2/R*
    Real x[N], y[N];  ///< deflections of the springs, in spacing^2/R* times mu/kappa
};

namespace springs {

template <int N, class Real, unsigned P>
void scale_lattice(Contact<N, Real, P>& c, void (*change)(Real (&)[N]), Real wider) {
    change(c.x);
    change(c.y);
    c.spacing *= wider;
    c.edge /= wider * wider;
    if constexpr ((P & viscous) != 0) change(c.pressed);
    if constexpr (P == (viscous | ledger)) {
        for (Real* each : {&c.limit, &c.drag_x, &c.drag_y}) *each /= wider * wider;
    }
}

constexpr double lever = 3.5;  // m*/m_t of solid spheres, which turn, too

/// Return what dashpots take of velocities in half a step, over those at its end, in compression and
/// in shear: k tau dt/(2 m*) at this radius of the contact.
template <class T> T damping_of(const PairOf<T>& pair, const T& radius, const T& per_force) {
    return pair.modulus * radius * per_force * pair.retardation;
}
template <class T> T shear_damping_of(const PairOf<T>& pair, const T& radius, const T& per_force) {
    const T modulus = pair.stiffness_ratio * pair.modulus;
    return lever * modulus * radius * per_force * pair.shear_retardation;
}

/// Return a number that Real can hold.
template <class Real, class T> T held(const T& all) {
    constexpr double most = 0.5 * std::numeric_limits<Real>::max();
    return larger(smaller(all, T{} + most), T{} - most);
}

/// Give springs their places at the first touch: so that the impact is to fill them.
template <int N, class Real, unsigned P>
inline void begin(Contact<N, Real, P>& c, const PairOf<double>& pair, const Motion& m) {
    constexpr double margin = 1.04;
    c = Contact<N, Real, P>{};
    const double energy = 0.9375 * pair.mass * m.approach * m.approach;
    const double deepest = std::pow(energy / (pair.modulus * std::sqrt(pair.radius)), 0.4);
    const double least = 1e-12 * pair.radius;  // below it single precision has no squares
    const double expected = std::min(std::max(deepest, m.penetration), pair.radius);
    const double reach = margin * std::max(expected, least);
    c.spacing = static_cast<Real>(std::sqrt(pair.radius * reach) / N);
    if constexpr ((P & viscous) != 0) {
        // bodies that begin pressed have been so for long
        const double from = m.penetration - m.approach * m.step;
        const double before = std::min(std::max(from, 0.0), pair.radius);
        const double edge = before * pair.radius / (double(c.spacing) * c.spacing);
        c.edge = static_cast<Real>(edge);
        for (int k = 0; k < N; ++k)
            c.pressed[k] = static_cast<Real>(std::max(edge - double(k) * k, 0.0));
        c.approach = static_cast<Real>(m.approach);
        c.slide_x = static_cast<Real>(m.slide_x);
        c.slide_y = static_cast<Real>(m.slide_y);
        const double width = std::sqrt(before * pair.radius);
        const double per_force = m.step / pair.mass;
        const double damping = damping_of(pair, width, per_force);
        const double shear_damping = shear_damping_of(pair, width, per_force);
        c.damped = static_cast<Real>(held<Real>(damping * m.approach));
        c.damped_x = static_cast<Real>(held<Real>(shear_damping * m.slide_x));
        c.damped_y = static_cast<Real>(held<Real>(shear_damping * m.slide_y));
        if constexpr ((P & ledger) != 0) {  // the energy of Hertz
            const double stiffness = 8.0 / 15.0 * pair.modulus * std::sqrt(pair.radius);
            c.stored = static_cast<Real>(stiffness * std::pow(before, 2.5));
        }
    }
}

/// Begin, widen the lattice if the contact has outgrown it, refine it if it has shrunk to a quarter.
template <int N, class Real, unsigned P>
inline void fit_lattice(Contact<N, Real, P>& c, const PairOf<double>& pair, const Motion& m) {
    if (!(c.spacing > 0)) begin(c, pair, m);
    const auto reach = [&] { return double(c.spacing) * c.spacing * (N * N); };
    const double square = m.penetration * pair.radius;
    if (m.approach < 0.0 && 16.0 * square < reach()) scale_lattice(c, refine<N, Real>, Real(0.5));
    while (square > reach()) scale_lattice(c, coarsen<N, Real>, Real(2));
}

/// Contacts in the lanes of T.
template <class T, class Kind> struct Row {
    Kind* all[width<T>];

    /// Return what they remember.
    template <class Real, class Of> T get(Real Of::*part) const {
        return converted<T>(by_lane<T, Real>([&](int k) { return all[k]->*part; }));
    }
    /// Let them remember.
    template <class Real, class Of> void keep(Real Of::*part, const T& values) const {
        const auto kept = converted<Alike<T, Real>>(values);
        for (int k = 0; k < width<T>; ++k) all[k]->*part = in_lane(kept, k);
    }
};

/// Fit those lattices that do not.
template <class T, int N, class Real, unsigned P>
inline void fit_lattices(const Row<T, Contact<N, Real, P>>& row, const PairOf<T>& pair,
                         const MotionOf<T>& m) {
    const T spacing = row.get(&Contact<N, Real, P>::spacing), square = m.penetration * pair.radius;
    const T reach = spacing * spacing * double(N * N);
    const auto is_fine = (m.approach >= 0.0) | (16.0 * square >= reach);
    if (!any((square > reach) | (is_fine == 0) | (spacing == 0.0))) return;
    for (int k = 0; k < width<T>; ++k) fit_lattice(*row.all[k], one_of(&pair, k), one_of(&m, k));
}

}  // namespace springs
}  // namespace carom

#include "own_names.h"

#endif
