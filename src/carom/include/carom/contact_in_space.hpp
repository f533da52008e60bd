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
    e.normal = {apart[0] / distance, apart[1] / distance, apart[2] / distance};
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

/// Carry the axis along: into the plane of the contact, which the bodies turn about its normal.
template <class Real> Vector carried(Real (&axis)[3], const Vector& normal, double angle) {
    Vector x = {double(axis[0]), double(axis[1]), double(axis[2])};
    x = plus(x, -dot(x, normal), normal);
    double length = std::sqrt(dot(x, x));
    if (!(length > 0.1)) {  // a first touch: any direction in the plane
        const Vector away = std::fabs(normal[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
        x = plus(away, -dot(away, normal), normal);
        length = std::sqrt(dot(x, x));
    }
    const Vector y = cross(normal, x);
    const double half = 0.5 * angle, scale = 1.0 / (length * (1.0 + half * half));
    const double c = (1.0 - half * half) * scale, s = 2.0 * half * scale;  // angle + O(angle^3)
    for (int i = 0; i < 3; ++i) axis[i] = static_cast<Real>(c * x[i] + s * y[i]);
    return {c * x[0] + s * y[0], c * x[1] + s * y[1], c * x[2] + s * y[2]};
}

}  // namespace springs

/// Set the torques that a force has on the bodies.
inline void turn(Action& action, const Encounter& e) {
    const Vector side = cross(action.force, e.normal);
    action.torque = {e.arm * side[0], e.arm * side[1], e.arm * side[2]};
    action.other_torque = {e.other_arm * side[0], e.other_arm * side[1], e.other_arm * side[2]};
}

/// Bring a contact in space to the end of a step and return what it does to the bodies.
template <int N, class Real, unsigned P>
Status advance(ContactInSpace<N, Real, P>& contact, const Pair& pair, const Encounter& e,
               Action& action) {
    const bool apart = !(contact.spacing > 0);
    const Vector axis = springs::carried(contact.axis, e.normal, apart ? 0.0 : e.spin * e.step);
    const Vector other = cross(e.normal, axis);
    const double approach = -dot(e.velocity, e.normal);
    const Motion motion{e.penetration, approach, dot(e.velocity, axis), dot(e.velocity, other),
                        e.step};
    Load load{};
    Contact<N, Real, P>& springs_only = contact;
    const Status status = advance(springs_only, pair, motion, load);
    if (status != Status::ok) return status;
    action.force = {0.0, 0.0, 0.0};
    action.force = plus(action.force, load.normal, e.normal);
    action.force = plus(action.force, -load.x, axis);
    action.force = plus(action.force, -load.y, other);
    turn(action, e);
    action.friction = load.friction;
    action.viscosity = load.viscosity;
    return Status::ok;
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
