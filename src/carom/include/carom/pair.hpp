// carom/pair.hpp: what a contact is told, two bodies and how they move, and what it answers.
//
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CAROM_PAIR_HPP
#define CAROM_PAIR_HPP

#include "own_names.h"

#include <algorithm>
#include <cmath>

namespace carom {

/// Two bodies as their contact knows them.
struct Pair {
    double modulus;          ///< E*: 1/E* = (1 - nu^2)/E of one body + that of the other
    double radius;           ///< R*: 1/R* = 1/R_1 + 1/R_2
    double stiffness_ratio;  ///< kappa = G*/E*: 1/G* = (2 - nu)(1 + nu)/(2 E), summed, too
    double friction;         ///< mu, 0 for none
    double mass;             ///< m_1 m_2/(m_1 + m_2): how deep an impact goes, from which springs
                             ///< get their places; forces do not depend on it
    double retardation = 0;  ///< time, of a Contact that is viscous
    bool viscous_shear = true;  ///< whether shear loses energy, too; if not, friction is exceeded
    double share = 0.5;  ///< of the penetration, by which the first body is flattened
};

/// Motion of the contact in a step: penetration at its end, velocities in its middle (those of
/// velocity Verlet while forces are computed), the step.
struct Motion {
    double penetration;
    double approach;  ///< normal velocity, positive while the bodies approach
    double slide_x, slide_y;  ///< tangential velocity of the contact point
    double step;
};

/// Forces at the end of a step, x and y against the slide, and the energy that was lost in it.
struct Load {
    double normal, x, y;
    double friction, viscosity;  ///< of a Contact that keeps a ledger
};

enum class Status { ok, bad_pair, bad_motion };

/// One line for a status.
inline const char* message(Status status) {
    if (status == Status::bad_pair)
        return "modulus, radius and mass must be from 1e-30 to 1e30, stiffness_ratio from 1e-6 to "
               "1e6, friction from 0 to 1e6, retardation from 0 to 1e30";
    if (status == Status::bad_motion)
        return "the motion must be within 1e30, the penetration below the radius, the step at "
               "least 1e-30 and, in single precision, 1e-12 of the retardation";
    return "ok";
}

// Within these no product of numbers leaves the range of double precision.
constexpr double largest = 1e30, largest_ratio = 1e6;

// A sum is small enough if all of its parts are; the least is large enough if all are.
inline bool is_good(const Pair& p) {
    const double all = p.modulus + p.radius + p.mass + p.retardation +
                       (p.stiffness_ratio + p.friction) * (largest / largest_ratio);
    const double least = std::min(std::min(p.modulus, p.radius),
                                  std::min(p.mass, p.stiffness_ratio * (largest_ratio / largest)));
    return all <= 8.0 * largest && least >= 1.0 / largest &&
           std::min(p.friction, p.retardation) >= 0.0;
}

inline bool is_good(const Motion& m, double radius, double shortest) {
    const double all = m.approach * m.approach + m.slide_x * m.slide_x + m.slide_y * m.slide_y +
                       m.penetration * m.penetration + m.step * m.step;
    return all <= largest * largest && m.step >= shortest && m.penetration < radius;
}

/// Whether a step can be taken, by numbers of this precision.
template <class Real> Status status_of(const Pair& pair, const Motion& motion) {
    if (!is_good(pair)) return Status::bad_pair;
    double shortest = 1.0 / largest;
    if (sizeof(Real) < sizeof(double)) shortest += 1e-12 * pair.retardation;
    return is_good(motion, pair.radius, shortest) ? Status::ok : Status::bad_motion;
}

}  // namespace carom

#include "own_names.h"

#endif
