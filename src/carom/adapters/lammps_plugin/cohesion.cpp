// What cohesion of spheres does to friction: the depth of Hertz's contact whose load sets its limit.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "cohesion.h"

#include <algorithm>
#include <cmath>

namespace LAMMPS_NS {
namespace {

constexpr double pi = 3.14159265358979323846;

/// A depth at the end of a step, and its derivative with respect to the penetration in its middle.
struct Depth {
    double value, slope;
};

/// Improve w > 1 with w^4 - (4/3) w = t, the root of a/a_c by JKR at the penetration t a_c^2/R.
double improved(double w, double t) {
    const double cube = w * w * w;
    return w - (w * (cube - 4.0 / 3.0) - t) / (4.0 * cube - 4.0 / 3.0);
}

/// Johnson, Kendall & Roberts (1971), in units of F_c and of u = a_c^2/R, a_c the radius at which the
/// contact is pulled off: with z = (a/a_c)^(3/2), F_n = z^2 - 2 z, so that F_n + 2 F_c = (z - 1)^2 + 1.
Depth of_jkr(double penetration, double middle, double unit) {
    const double end = penetration / unit, least = -1.0 / 3.0;
    if (!(end > least)) return {0.0, 0.0};
    double w = std::sqrt(std::sqrt(end + 4.0 / 3.0));  // off by 4 %
    for (int i = 0; i < 4; ++i) w = improved(w, end);
    const auto load = [](double z) { return (z - 1.0) * (z - 1.0) + 1.0; };
    const double root = std::cbrt(load(w * w * w));
    const double there = std::max(middle / unit, least);  // half a step away
    w = improved(improved(w, there), there);
    const double z = w * w * w, third = (2.0 * root + load(z) / (root * root)) / 3.0;
    return {unit * root * root, (z - 1.0) * w * w / ((z - 1.0 / 3.0) * third)};
}

/// A constant attraction: F_n + 2 F_c = Hertz's load + F_c, the latter that at the depth `unit`.
Depth of_constant(double penetration, double middle, double unit) {
    if (!(penetration > 0.0)) return {0.0, 0.0};
    const auto root = [&](double depth) {
        return std::cbrt(depth * std::sqrt(depth) + unit * std::sqrt(unit));
    };
    const double value = root(penetration), there = std::max(middle, 0.0);
    return {value * value, std::sqrt(there) / root(there)};
}

double unit_of(const CaromCohesion &cohesion, double radius) {
    const double root = std::cbrt(radius);
    return cohesion.kind == CaromCohesion::pulloff ? cohesion.unit / root : cohesion.unit * root;
}

}  // namespace

CaromCohesion carom_cohesion(CaromCohesion::Kind kind, double value, double modulus) {
    double force = value;  // at R* = 1
    if (kind == CaromCohesion::jkr) force = 3.0 * pi * value;
    if (kind == CaromCohesion::dmt) force = 4.0 * pi * value;
    return {kind, value, std::pow(0.75 * force / modulus, 2.0 / 3.0)};
}

double carom_neck(const CaromCohesion &cohesion, double radius) {
    return cohesion.kind == CaromCohesion::jkr ? unit_of(cohesion, radius) / 3.0 : 0.0;
}

void carom_cohere(const CaromCohesion &cohesion, double radius, carom::Encounter &now) {
    const double unit = unit_of(cohesion, radius), part = carom::dot(now.velocity, now.normal);
    const double middle = now.penetration + 0.5 * part * now.step;
    const Depth depth = cohesion.kind == CaromCohesion::jkr
                            ? of_jkr(now.penetration, middle, unit)
                            : of_constant(now.penetration, middle, unit);
    now.velocity = carom::plus(now.velocity, (depth.slope - 1.0) * part, now.normal);
    now.penetration = depth.value;
}

}  // namespace LAMMPS_NS
