// What cohesion of spheres does to friction: the depth of Hertz's contact whose load sets its limit.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_COHESION_H
#define CAROM_COHESION_H

#include "carom/encounter.hpp"

namespace LAMMPS_NS {

/// How two bodies cohere: by a surface energy (of either body), or by a pull-off force.
struct CaromCohesion {
    enum Kind { none, jkr, dmt, pulloff };
    Kind kind = none;
    double value = 0.0;
    double unit = 0.0;  ///< depth at which Hertz's load is the pull-off force F_c, at R* = 1

    explicit operator bool() const { return kind != none; }
};

/// Return the cohesion of bodies with this E*.
CaromCohesion carom_cohesion(CaromCohesion::Kind, double value, double modulus);

/// Return how far apart surfaces may be that have touched: by JKR they are drawn out to a neck.
double carom_neck(const CaromCohesion &, double radius);

/// Put the depth at which Hertz's load is F_n + 2 F_c in place of the penetration, and the velocity
/// with which it changes in place of the normal one (Thornton 1991: friction bears mu (F_n + 2 F_c)).
void carom_cohere(const CaromCohesion &, double radius, carom::Encounter &);

}  // namespace LAMMPS_NS

#endif
