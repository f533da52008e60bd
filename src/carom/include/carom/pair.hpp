// carom/pair.hpp: what a contact is told, two bodies and how they move, and what it answers.
//
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CAROM_PAIR_HPP
#define CAROM_PAIR_HPP

#include "lanes.hpp"

#include "own_names.h"

#include <algorithm>

namespace carom {

/// Two bodies as their contact knows them.
struct Pair {
    double modulus;          ///< E*: 1/E* = (1 - nu^2)/E of one body + that of the other
    double radius;           ///< R*: 1/R* = 1/R_1 + 1/R_2
    double stiffness_ratio;  ///< kappa = G*/E*: 1/G* = (2 - nu)(1 + nu)/(2 E), summed, too
    double friction;         ///< mu, 0 for none
    double mass;             ///< m_1 m_2/(m_1 + m_2): how deep an impact goes, from which springs
                             ///< get their places; forces do not depend on it
    double retardation = 0;  ///< time, of a Contact that is viscous; 0 for others
    bool viscous_shear = true;  ///< whether shear loses energy, too; if not, friction is exceeded
    double share = 0.5;  ///< of the penetration, by which the first body is flattened
};

/// Motion of the contact in a step: penetration at its end, velocities in its middle (those of
/// velocity Verlet while forces are computed), the step.
template <class T> struct MotionOf {
    T penetration;
    T approach;  ///< normal velocity, positive while the bodies approach
    T slide_x, slide_y;  ///< tangential velocity of the contact point
    T step;
};

/// Forces at the end of a step, x and y against the slide, and the energy that was lost in it.
template <class T> struct LoadOf {
    T normal, x, y;
    T friction, viscosity;  ///< of a Contact that keeps a ledger
};

using Motion = MotionOf<double>;
using Load = LoadOf<double>;

enum class Status { ok, bad_pair, bad_motion };

/// One line for a status.
inline const char* message(Status status) {
    if (status == Status::bad_pair)
        return "modulus, radius and mass must be from 1e-30 to 1e30, stiffness_ratio from 1e-6 to "
               "1e6, friction from 0 to 1e6, retardation from 0 to 1e30; a contact with a retardation "
               "is viscous";
    if (status == Status::bad_motion)
        return "the motion must be within 1e30, the penetration below the radius, the step at "
               "least 1e-30 and, in single precision, 1e-12 of the retardation";
    return "ok";
}

// Within these no product of numbers leaves the range of double precision.
constexpr double largest = 1e30, largest_ratio = 1e6;

namespace springs {

/// Pairs in lanes; in shear they may have no losses.
template <class T> struct PairOf {
    T modulus, radius, stiffness_ratio, friction, mass, retardation, shear_retardation;
};

/// Set pairs in lanes; those left over are the last one.
template <class T> inline void set_pairs(PairOf<T>& all, const Pair pairs[], int count) {
    const Pair* each[width<T>];
    for (int k = 0; k < width<T>; ++k) each[k] = pairs + std::min(k, count - 1);
    const auto set = [&](T PairOf<T>::*to, double Pair::*part) {
        all.*to = by_lane<T, double>([&](int k) { return each[k]->*part; });
    };
    set(&PairOf<T>::modulus, &Pair::modulus);
    set(&PairOf<T>::radius, &Pair::radius);
    set(&PairOf<T>::stiffness_ratio, &Pair::stiffness_ratio);
    set(&PairOf<T>::friction, &Pair::friction);
    set(&PairOf<T>::mass, &Pair::mass);
    set(&PairOf<T>::retardation, &Pair::retardation);
    all.shear_retardation = by_lane<T, double>(
        [&](int k) { return each[k]->viscous_shear ? each[k]->retardation : 0.0; });
}

// A sum is small enough if all of its parts are; the least is large enough if all are.
template <class T> auto is_good(const PairOf<T>& p) {
    const T all = p.modulus + p.radius + p.mass + p.retardation +
                  (p.stiffness_ratio + p.friction) * (largest / largest_ratio);
    const T least = smaller(smaller(p.modulus, p.radius),
                            smaller(p.mass, p.stiffness_ratio * (largest_ratio / largest)));
    return (all <= 8.0 * largest) & (least >= 1.0 / largest) &
           (smaller(p.friction, p.retardation) >= 0.0);
}

template <class T> auto is_good(const MotionOf<T>& m, const T& radius, const T& shortest) {
    const T all = m.approach * m.approach + m.slide_x * m.slide_x + m.slide_y * m.slide_y +
                  m.penetration * m.penetration + m.step * m.step;
    return (all <= largest * largest) & (m.step >= shortest) & (m.penetration < radius);
}

/// Say of steps whether they can be taken, by numbers of this precision; losses by viscous contacts.
template <class Real, bool viscous, class T>
inline void set_statuses(const PairOf<T>& pair, const MotionOf<T>& motion, Status statuses[], int count) {
    constexpr double part = sizeof(Real) < sizeof(double) ? 1e-12 : 0.0;
    auto pair_good = is_good(pair);
    if constexpr (!viscous) pair_good = pair_good & (pair.retardation == 0.0);
    const T shortest = 1.0 / largest + part * pair.retardation;
    const auto motion_good = is_good(motion, pair.radius, shortest);
    for (int k = 0; k < count; ++k)
        statuses[k] = !in_lane(pair_good, k)     ? Status::bad_pair
                      : !in_lane(motion_good, k) ? Status::bad_motion
                                                 : Status::ok;
}

}  // namespace springs
}  // namespace carom

#include "own_names.h"

#endif
