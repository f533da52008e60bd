// carom/pair.hpp: what a contact is told, two bodies and how they move, and what it answers.
//
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CAROM_PAIR_HPP
#define CAROM_PAIR_HPP

#include <cmath>
#include <limits>

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
        return "modulus, radius, stiffness_ratio and mass must be positive and finite, friction "
               "and retardation zero or positive";
    if (status == Status::bad_motion)
        return "the motion must be finite, the step positive, the penetration below the radius";
    return "ok";
}

inline bool is_good(const Pair& p) {
    const double most = std::numeric_limits<double>::max();
    return p.modulus > 0.0 && p.modulus <= most && p.radius > 0.0 && p.radius <= most &&
           p.stiffness_ratio > 0.0 && p.stiffness_ratio <= most && p.mass > 0.0 && p.mass <= most &&
           p.friction >= 0.0 && p.friction <= most && p.retardation >= 0.0 && p.retardation <= most;
}

inline bool is_good(const Motion& m, double radius) {
    return std::isfinite(m.approach) && std::isfinite(m.slide_x) && std::isfinite(m.slide_y) &&
           m.step > 0.0 && std::isfinite(m.step) && m.penetration < radius &&
           m.penetration > -std::numeric_limits<double>::infinity();
}

}  // namespace carom

#endif
