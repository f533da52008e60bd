// What cohesion of spheres does to friction: the depth of Hertz's contact whose load sets its limit.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "cohesion.h"

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {
namespace {

constexpr double pi = 3.14159265358979323846;

/// A depth, and its derivative with respect to the penetration.
struct Depth {
    double value, slope;
};

/// Return w > 1 with w^4 - (4/3) w = t: the root of a/a_c by JKR, at the penetration t a_c^2/R.
double root_of_radius(double t) {
    double w = std::sqrt(std::sqrt(std::max(t, 0.0))) + 1.2;  // Newton's steps come from above
    for (int i = 0; i < 60; ++i) {
        const double less = (w * (w * w * w - 4.0 / 3.0) - t) / (4.0 * w * w * w - 4.0 / 3.0);
        w -= less;
        if (less < 1e-15 * w) break;
    }
    return w;
}

/// Johnson, Kendall & Roberts (1971), in units of F_c and of u = a_c^2/R, a_c the radius at which the
/// contact is pulled off: with z = (a/a_c)^(3/2), F_n = z^2 - 2 z, so that F_n + 2 F_c = (z - 1)^2 + 1.
Depth of_jkr(double penetration, double unit) {
    if (penetration <= -unit / 3.0) return {0.0, 0.0};
    const double w = root_of_radius(penetration / unit), z = w * w * w;
    const double load = (z - 1.0) * (z - 1.0) + 1.0, root = std::cbrt(load);
    return {unit * root * root, (z - 1.0) * w * w / ((z - 1.0 / 3.0) * root)};
}

/// A constant attraction: F_n + 2 F_c = Hertz's load + F_c, which is that at the depth `adds` alone.
Depth of_constant(double penetration, double adds) {
    if (penetration <= 0.0) return {0.0, 0.0};
    const double root = std::cbrt(std::pow(penetration, 1.5) + std::pow(adds, 1.5));
    return {root * root, std::sqrt(penetration) / root};
}

/// Return the depth at which Hertz's load is F_c; by JKR it is a_c^2/R.
double unit_of(const CaromCohesion &cohesion, const carom::Pair &pair) {
    const double force = carom_pulloff(cohesion, pair.radius);
    return std::pow(0.75 * force / (pair.modulus * std::sqrt(pair.radius)), 2.0 / 3.0);
}

}  // namespace

double carom_pulloff(const CaromCohesion &cohesion, double radius) {
    if (cohesion.kind == CaromCohesion::jkr) return 3.0 * pi * cohesion.value * radius;
    if (cohesion.kind == CaromCohesion::dmt) return 4.0 * pi * cohesion.value * radius;
    return cohesion.kind == CaromCohesion::pulloff ? cohesion.value : 0.0;
}

double carom_neck(const CaromCohesion &cohesion, const carom::Pair &pair) {
    return cohesion.kind == CaromCohesion::jkr ? unit_of(cohesion, pair) / 3.0 : 0.0;
}

void carom_cohere(const CaromCohesion &cohesion, const carom::Pair &pair, carom::Encounter &now) {
    const double unit = unit_of(cohesion, pair), part = carom::dot(now.velocity, now.normal);
    const auto at = [&](double penetration) {
        return cohesion.kind == CaromCohesion::jkr ? of_jkr(penetration, unit)
                                                   : of_constant(penetration, unit);
    };
    const double middle = now.penetration + 0.5 * part * now.step;
    now.velocity = carom::plus(now.velocity, (at(middle).slope - 1.0) * part, now.normal);
    now.penetration = at(now.penetration).value;
}

}  // namespace LAMMPS_NS
