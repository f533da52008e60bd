// carom/contact_in_space.hpp: contacts of spheres that move and turn in space.
//
// SPDX-License-Identifier: BSD-3-Clause
//
//     carom::Pair pair = carom::pair_of(steel, glass, {r_1, m_1}, {r_2, m_2}, friction);
//     carom::ContactInSpace<32> contact{};
//     carom::Action action{};
//     carom::advance(contact, pair, carom::encounter(one, other, step), action);
//
// `action` holds the force on the first sphere, and the torque on either.
#ifndef CAROM_CONTACT_IN_SPACE_HPP
#define CAROM_CONTACT_IN_SPACE_HPP

#include <array>

#include "contact.hpp"

namespace carom {

using Vector = std::array<double, 3>;

inline double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// a + factor b
inline Vector plus(const Vector& a, double factor, const Vector& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

/// An elastic solid: Young's modulus, infinite for a rigid one, and Poisson's ratio.
struct Material {
    double young, poisson;
};

/// Size of a body: its radius, infinite for a wall, negative for the inside of a bowl; its mass.
struct Size {
    double radius, mass;
};

/// A sphere on its way; of a wall the position is the point of it that is nearest.
struct Body {
    Vector position, velocity, spin;
    double radius;  ///< 0 for a wall
};

/// What the contact sees of two bodies.
struct Encounter {
    Vector normal;    ///< from the second body to the first, of length one
    Vector velocity;  ///< of the first body's contact point less that of the second's
    double penetration;
    double spin;  ///< mean spin of the bodies about the normal, by which the contact turns
    double step;
    double arm, other_arm;  ///< from the centres to the contact
};

/// Force on the first body, the opposite on the second; torques; energies lost in the step.
struct Action {
    Vector force, torque, other_torque;
    double friction, viscosity;
};

/// The memory of a contact in space: that in its plane, and the direction in it that is called x.
template <int N, class Real = double, unsigned P = elastic>
struct ContactInSpace : Contact<N, Real, P> {
    Real axis[3];
};

/// Return the pair of two bodies (Hertz 1882; Mindlin 1949).
inline Pair pair_of(Material one, Material other, Size first, Size second, double friction,
                    double retardation = 0.0) {
    const auto soft = [](Material m) { return (1.0 - m.poisson * m.poisson) / m.young; };
    const auto lax = [](Material m) {
        return (2.0 - m.poisson) * (1.0 + m.poisson) / (2.0 * m.young);
    };
    Pair pair{};
    pair.modulus = 1.0 / (soft(one) + soft(other));
    pair.stiffness_ratio = (soft(one) + soft(other)) / (lax(one) + lax(other));
    pair.radius = 1.0 / (1.0 / first.radius + 1.0 / second.radius);
    pair.mass = 1.0 / (1.0 / first.mass + 1.0 / second.mass);
    pair.friction = friction;
    pair.retardation = retardation;
    return pair;
}

/// Return what a contact sees of two spheres.
inline Encounter encounter(const Body& one, const Body& other, double step) {
    Encounter e{};
    const Vector apart = plus(one.position, -1.0, other.position);
    const double distance = std::sqrt(dot(apart, apart));
    const double per_distance = 1.0 / distance;
    for (int i = 0; i < 3; ++i) e.normal[i] = per_distance * apart[i];
    e.penetration = one.radius + other.radius - distance;
    // both points are one, so that angular momentum is kept
    e.other_arm = other.radius > 0.0 ? other.radius - 0.5 * e.penetration : 0.0;
    e.arm = distance - e.other_arm;
    e.velocity = plus(one.velocity, -1.0, other.velocity);
    e.velocity = plus(e.velocity, -e.arm, cross(one.spin, e.normal));
    e.velocity = plus(e.velocity, -e.other_arm, cross(other.spin, e.normal));
    e.spin = 0.5 * (dot(one.spin, e.normal) + dot(other.spin, e.normal));
    e.step = step;
    return e;
}

namespace springs {

/// Return the axis carried along: into the plane of the contact, which turns about its normal.
template <class Real>
inline Vector carried(const Real (&axis)[3], const Vector& normal, double angle) {
    Vector x = {double(axis[0]), double(axis[1]), double(axis[2])};
    x = plus(x, -dot(x, normal), normal);
    double square = dot(x, x);
    if (!(square > 0.01)) {  // a first touch: any direction in the plane
        const Vector away = std::fabs(normal[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
        x = plus(away, -dot(away, normal), normal);
        square = dot(x, x);
    }
    const Vector y = cross(normal, x);
    const double half = 0.5 * angle, c = 1.0 - half * half, s = 2.0 * half;  // angle + O(angle^3)
    square *= (1.0 + half * half) * (1.0 + half * half);
    const bool is_near = std::fabs(square - 1.0) < 1e-6;  // as it is in every step but the first
    const double scale = is_near ? 1.5 - 0.5 * square : 1.0 / std::sqrt(square);
    return {scale * (c * x[0] + s * y[0]), scale * (c * x[1] + s * y[1]),
            scale * (c * x[2] + s * y[2])};
}

}  // namespace springs

/// Set the torques that a force has on the bodies.
inline void turn(Action& action, const Encounter& e) {
    const Vector side = cross(action.force, e.normal);
    action.torque = {e.arm * side[0], e.arm * side[1], e.arm * side[2]};
    action.other_torque = {e.other_arm * side[0], e.other_arm * side[1], e.other_arm * side[2]};
}

namespace springs {

/// What an encounter is in the plane of the contact, between the stages of a step.
struct InPlane {
    Vector x, y;
    Motion motion;
    Stage stage;
};

/// Find the plane and the motion in it.
template <int N, class Real, unsigned P>
inline Status face(ContactInSpace<N, Real, P>& contact, const Pair& pair, const Encounter& e,
                   InPlane& plane) {
    const double angle = contact.spacing > 0 ? e.spin * e.step : 0.0;
    plane.x = carried(contact.axis, e.normal, angle);
    plane.y = cross(e.normal, plane.x);
    plane.motion = {e.penetration, -dot(e.velocity, e.normal), dot(e.velocity, plane.x),
                    dot(e.velocity, plane.y), e.step};
    const Status status = status_of(pair, plane.motion);
    if (status == Status::ok)
        for (int i = 0; i < 3; ++i) contact.axis[i] = static_cast<Real>(plane.x[i]);
    return status;
}

/// Return what a load does to the bodies.
inline void act(const Load& load, const InPlane& plane, const Encounter& e, Action& action) {
    const Vector aside = plus({load.x * plane.x[0], load.x * plane.x[1], load.x * plane.x[2]},
                              load.y, plane.y);
    action.force = {load.normal * e.normal[0] - aside[0], load.normal * e.normal[1] - aside[1],
                    load.normal * e.normal[2] - aside[2]};
    turn(action, e);
    action.friction = load.friction;
    action.viscosity = load.viscosity;
}

}  // namespace springs

/// Bring contacts in space to the end of a step and return what they do to the bodies; nothing
/// changes of one whose status is not ok. Several at once take less time than one by one.
template <int N, class Real, unsigned P>
inline void advance(ContactInSpace<N, Real, P>* const contacts[], const Pair pairs[],
                    const Encounter meetings[], Action actions[], Status statuses[], int count) {
    constexpr int together = 16;
    springs::InPlane planes[together];
    for (int from = 0; from < count; from += together) {
        const int to = count - from < together ? count : from + together;
        int pressed = 0, places[together];
        for (int k = from; k < to; ++k) {
            springs::InPlane& plane = planes[pressed];
            statuses[k] = springs::face(*contacts[k], pairs[k], meetings[k], plane);
            if (statuses[k] != Status::ok) continue;
            if (plane.motion.penetration > 0.0) {
                places[pressed++] = k;
            } else {
                Load load{};
                springs::part(*contacts[k], plane.motion, load);
                springs::act(load, plane, meetings[k], actions[k]);
            }
        }
        for (int i = 0; i < pressed; ++i)
            springs::prepare(*contacts[places[i]], pairs[places[i]], planes[i].motion,
                             planes[i].stage);
        for (int i = 0; i < pressed; ++i)
            springs::march(*contacts[places[i]], pairs[places[i]], planes[i].stage);
        for (int i = 0; i < pressed; ++i) {
            const int k = places[i];
            Load load;
            springs::settle(*contacts[k], pairs[k], planes[i].motion, planes[i].stage, load);
            springs::act(load, planes[i], meetings[k], actions[k]);
        }
    }
}

/// Bring one contact in space to the end of a step.
template <int N, class Real, unsigned P>
inline Status advance(ContactInSpace<N, Real, P>& contact, const Pair& pair, const Encounter& e,
                      Action& action) {
    ContactInSpace<N, Real, P>* const one = &contact;
    Status status = Status::ok;
    advance(&one, &pair, &e, &action, &status, 1);
    return status;
}

/// Make the memory of a contact that of the second body's side, whose normal is the opposite one.
template <int N, class Real, unsigned P> void mirror(ContactInSpace<N, Real, P>& contact) {
    for (Real& each : contact.axis) each = -each;
    for (Real& each : contact.y) each = -each;
    if constexpr ((P & viscous) != 0) {
        contact.slide_y = -contact.slide_y;
        contact.drag_y = -contact.drag_y;
    }
    if constexpr ((P & ledger) != 0) contact.shear_y = -contact.shear_y;
}
}  // namespace carom

#endif
