// carom/encounter.hpp: spheres that move and turn in space, as their contact sees them.
//
// SPDX-License-Identifier: BSD-3-Clause
//
// Of one contact (Body, Encounter, Action), or of several in the lanes of a register (Bodies,
// Encounters, Actions), by the same functions.
#ifndef CAROM_ENCOUNTER_HPP
#define CAROM_ENCOUNTER_HPP

#include "lanes.hpp"
#include "pair.hpp"

#include "own_names.h"

#include <array>

namespace carom {

template <class T> using Triple = std::array<T, 3>;
using Vector = Triple<double>;

template <class T> T dot(const Triple<T>& a, const Triple<T>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T> Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T, class Factor> Triple<T> times(Factor factor, const Triple<T>& a) {
    return {factor * a[0], factor * a[1], factor * a[2]};
}
/// a + factor b
template <class T, class Factor>
Triple<T> plus(const Triple<T>& a, Factor factor, const Triple<T>& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

/// A sphere on its way. Of a wall the position is its point that is nearest to the sphere, and the
/// velocity that of this point.
template <class T> struct BodyOf {
    Triple<T> position, velocity, spin;
    T radius;  ///< 0 for a wall
};

/// What the contact sees of two bodies.
template <class T> struct EncounterOf {
    Triple<T> normal;    ///< from the second body to the first, of length one
    Triple<T> velocity;  ///< of the first body's contact point less that of the second's
    T penetration;
    T spin;  ///< mean spin of the bodies about the normal, by which the contact turns
    T step;
    T arm, other_arm;  ///< from the centres to the contact
};

/// Force on the first body, the opposite on the second; torques; energies lost in the step.
template <class T> struct ActionOf {
    Triple<T> force, torque, other_torque;
    T friction, viscosity;
};

using Body = BodyOf<double>;
using Encounter = EncounterOf<double>;
using Action = ActionOf<double>;

/// Several at once: number k is in lane k % lanes of structure k / lanes.
using Bodies = BodyOf<Wide::Type>;
using Encounters = EncounterOf<Wide::Type>;
using Actions = ActionOf<Wide::Type>;

inline Vector in_lane(const Triple<Wide::Type>& all, int lane) {
    return {in_lane(all[0], lane), in_lane(all[1], lane), in_lane(all[2], lane)};
}

/// Return what a contact sees of two spheres. Each is flattened by its part of the penetration, at
/// the centre of Hertz's contact; `share_of` is that of the first one, 1/2 for like materials.
template <class T>
EncounterOf<T> encounter(const BodyOf<T>& one, const BodyOf<T>& other, double step, T share) {
    EncounterOf<T> e;
    const Triple<T> apart = plus(one.position, -1.0, other.position);
    const T distance = springs::root(dot(apart, apart)), none{};
    e.normal = times(1.0 / distance, apart);
    e.penetration = one.radius + other.radius - distance;
    // both points are one, so that angular momentum is kept
    e.arm = one.radius - share * e.penetration;
    e.other_arm = other.radius > none ? distance - e.arm : none;
    e.velocity = plus(one.velocity, -1.0, other.velocity);
    e.velocity = plus(e.velocity, -e.arm, cross(one.spin, e.normal));
    e.velocity = plus(e.velocity, -e.other_arm, cross(other.spin, e.normal));
    e.spin = 0.5 * (dot(one.spin, e.normal) + dot(other.spin, e.normal));
    e.step = none + step;
    return e;
}

template <class T>
EncounterOf<T> encounter(const BodyOf<T>& one, const BodyOf<T>& other, double step) {
    return encounter(one, other, step, 0.5 + T{});
}

/// Return what a contact sees of two bodies whose pair was made of their materials.
inline Encounter encounter(const Body& one, const Body& other, double step, const Pair& pair) {
    return encounter(one, other, step, pair.share);
}

/// Set the torques that a force has on the bodies.
template <class T> void turn(ActionOf<T>& action, const EncounterOf<T>& e) {
    const Triple<T> side = cross(action.force, e.normal);
    action.torque = times(e.arm, side);
    action.other_torque = times(e.other_arm, side);
}

}  // namespace carom

#include "own_names.h"

#endif
