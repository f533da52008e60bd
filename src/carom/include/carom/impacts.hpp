// carom/impacts.hpp: how long bodies touch, and the retardation time that a restitution stands for.
//
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CAROM_IMPACTS_HPP
#define CAROM_IMPACTS_HPP

#include "contact.hpp"

#include "own_names.h"

#include <cmath>

namespace carom {
namespace springs {

/// Velocity after a normal impact in the units of Hertz's, d_max = V_1 = 1.
inline double rebound(double loss) {
    Pair pair{1.0, 1e6, 1.0, 0.0, 1.0, loss};
    pair.modulus = 0.9375 / std::sqrt(pair.radius);
    Contact<8, double, viscous> contact{};
    Load load{};
    const double step = 2e-4;
    double depth = 0.0, speed = 1.0;
    for (int i = 0; i < 1000000; ++i) {
        speed -= 0.5 * step * load.normal;
        depth += step * speed;
        advance(contact, pair, {depth, speed, 0.0, 0.0, step}, load);
        speed -= 0.5 * step * load.normal;
        if (speed < 0.0 && load.normal <= 0.0) break;
    }
    return -speed;
}

}  // namespace springs

/// Return alpha = tau V_1/d_max at which spheres of Kelvin & Voigt's solid rebound with this
/// restitution, from 0.01 to 1. It takes a tenth of a second, and belongs at the start of a run.
inline double loss_of(double restitution) {
    if (restitution > 0.9999) return 1e4 * (1.0 - restitution) * loss_of(0.9999);
    double low = 0.0, high = 1.0;
    while (springs::rebound(high) > restitution) high *= 2.0;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (springs::rebound(middle) > restitution ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Return the retardation time of bodies with this loss when they meet at this normal speed.
inline double retardation_of(double loss, const Pair& pair, double speed) {
    const double natural = 0.9375 * pair.mass / (pair.modulus * std::sqrt(pair.radius));
    return loss * std::pow(natural, 0.4) * std::pow(speed, -0.2);  // d_max/V_1 of the elastic impact
}

/// Return how long elastic bodies touch that meet at this normal speed (Hertz 1882).
inline double duration_of(const Pair& pair, double speed) {
    return 2.9432751843247047 * retardation_of(1.0, pair, speed);
}

/// k dt^2/m* of a contact, k = 2 E* a, up to which bodies keep their energy, however many touch.
constexpr double stiffest_step = 0.1;

/// Return whether a step is too long for a contact that is pressed so far, or for any in the lanes of T.
template <class T>
bool is_too_stiff(const T& modulus, const T& radius, const T& mass, const T& penetration, double step) {
    const T stiffness = 2.0 / stiffest_step * step * step * modulus;
    return springs::any(stiffness * stiffness * radius * penetration > mass * mass);
}

inline bool is_too_stiff(const Pair& pair, double penetration, double step) {
    return is_too_stiff(pair.modulus, pair.radius, pair.mass, penetration, step);
}

/// Return the longest step that is not too long.
inline double longest_step(const Pair& pair, double penetration) {
    const double stiffness = 2.0 * pair.modulus * std::sqrt(pair.radius * penetration);
    return std::sqrt(stiffest_step * pair.mass / stiffness);
}

}  // namespace carom

#include "own_names.h"

#endif
