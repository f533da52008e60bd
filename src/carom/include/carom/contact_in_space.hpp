// carom/contact_in_space.hpp: contacts of spheres that move and turn in space.
//
// SPDX-License-Identifier: BSD-3-Clause
//
//     carom::Pair pair = carom::pair_of(steel, glass, {r_1, m_1}, {r_2, m_2}, friction);
//     carom::ContactInSpace<> contact{};
//     carom::Action action{};
//     carom::advance(contact, pair, carom::encounter(one, other, step, pair), action);
//
// `action` holds the force on the first body, whose opposite acts on the second, and the torque on
// either, right-handed: each is added to the spin of its own body.
#ifndef CAROM_CONTACT_IN_SPACE_HPP
#define CAROM_CONTACT_IN_SPACE_HPP

#include "contact.hpp"
#include "encounter.hpp"
#include "impacts.hpp"

#include "own_names.h"

namespace carom {

/// An elastic solid: Young's modulus, infinite for a rigid one, and Poisson's ratio.
struct Material {
    double young, poisson;
};

/// Size of a body: its radius, infinite for a wall, negative for the inside of a bowl; its mass.
struct Size {
    double radius, mass;
};

/// The memory of a contact in space: that in its plane, and the direction in it that is called x.
template <int N = 16, class Real = double, unsigned P = elastic>
struct ContactInSpace : Contact<N, Real, P> {
    Real axis[3];
};

namespace springs {

inline double soft(Material m) { return (1.0 - m.poisson) * (1.0 + m.poisson) / m.young; }

}  // namespace springs

/// Return the part of the penetration by which the first of two bodies is flattened.
inline double share_of(Material one, Material other) {
    return springs::soft(one) / (springs::soft(one) + springs::soft(other));
}

/// Return the pair with bodies of these sizes, in the order of the pair's materials.
inline Pair with_sizes(Pair pair, Size first, Size second) {
    pair.radius = 1.0 / (1.0 / first.radius + 1.0 / second.radius);
    pair.mass = 1.0 / (1.0 / first.mass + 1.0 / second.mass);
    return pair;
}

/// Return the pair of two bodies (Hertz 1882; Mindlin 1949).
inline Pair pair_of(Material one, Material other, Size first, Size second, double friction,
                    double retardation = 0.0) {
    using springs::soft;
    const auto lax = [](Material m) {
        return (2.0 - m.poisson) * (1.0 + m.poisson) / (2.0 * m.young);
    };
    Pair pair{};
    pair.modulus = 1.0 / (soft(one) + soft(other));
    pair.stiffness_ratio = (soft(one) + soft(other)) / (lax(one) + lax(other));
    pair.friction = friction;
    pair.retardation = retardation;
    pair.share = share_of(one, other);
    return with_sizes(pair, first, second);
}

namespace springs {

/// Return the axis, or another direction if it has come to stand along the normal: as has that of a
/// first touch, all zeros.
template <class Real> Vector axis_of(const Real (&axis)[3], const Vector& normal) {
    const Vector x = {double(axis[0]), double(axis[1]), double(axis[2])};
    const double along = dot(x, normal);
    if (dot(x, x) - along * along > 0.01) return x;
    return std::fabs(normal[0]) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
}

/// The plane of a contact: its axes, and the motion in it.
template <class T> struct Plane {
    Triple<T> x, y;
    T approach, slide_x, slide_y;
};

/// Carry an axis along, into the plane of the contact, which turns about its normal.
template <class T> Plane<T> plane_of(const Triple<T>& axis, const EncounterOf<T>& e) {
    Plane<T> plane;
    const Triple<T> x = plus(axis, -dot(axis, e.normal), e.normal), y = cross(e.normal, x);
    const T half = 0.5 * e.spin * e.step, square = half * half;  // by the angle + O(angle^3)
    const T scale = 1.0 / (root(dot(x, x)) * (1.0 + square));
    plane.x = plus(times(scale * (1.0 - square), x), scale * (half + half), y);
    plane.y = cross(e.normal, plane.x);
    plane.approach = -dot(e.velocity, e.normal);
    plane.slide_x = dot(e.velocity, plane.x);
    plane.slide_y = dot(e.velocity, plane.y);
    return plane;
}

/// Return what forces in the plane, against the slide, do to the bodies.
template <class T>
ActionOf<T> act(T normal, T x, T y, const Plane<T>& plane, const EncounterOf<T>& e) {
    ActionOf<T> action;
    action.force = plus(plus(times(normal, e.normal), -x, plane.x), -y, plane.y);
    turn(action, e);
    return action;
}

template <class Real> void keep_axis(Real (&axis)[3], const Vector& x) {
    for (std::size_t i = 0; i < 3; ++i) axis[i] = static_cast<Real>(x[i]);
}

}  // namespace springs

/// Bring one contact in space to the end of a step.
template <int N, class Real, unsigned P>
inline Status advance(ContactInSpace<N, Real, P>& contact, const Pair& pair, const Encounter& e,
                      Action& action) {
    const auto plane = springs::plane_of(springs::axis_of(contact.axis, e.normal), e);
    Load load;
    const Motion motion{e.penetration, plane.approach, plane.slide_x, plane.slide_y, e.step};
    const Status status = advance(contact, pair, motion, load);
    if (status != Status::ok) return status;
    springs::keep_axis(contact.axis, plane.x);
    action = springs::act(load.normal, load.x, load.y, plane, e);
    action.friction = load.friction;
    action.viscosity = load.viscosity;
    return status;
}

namespace springs {

/// Return the axes of contacts in lanes; those left over have that of the last.
template <class Contact>
Triple<Wide::Type> axes_of(Contact* const contacts[], const Encounters& e, int count) {
    Vector axes[lanes];
    for (int k = 0; k < lanes; ++k)
        axes[k] = axis_of(contacts[std::min(k, count - 1)]->axis, in_lane(e.normal, k));
    const auto along = [&](std::size_t i) { return Wide::each([&](int k) { return axes[k][i]; }); };
    return {along(0), along(1), along(2)};
}

constexpr int together = 16;  // contacts in a batch

/// A step of contacts in lanes, in their planes.
template <int N, class Real, unsigned P> struct StageInSpace : Stage<Wide::Type, N, Real, P> {
    Plane<Wide::Type> plane;
    MotionOf<Wide::Type> motion;
    LoadOf<Wide::Type> parted;  ///< loads of those that are not pressed
    bool pressed[lanes];

    /// See how bodies meet. Lanes without a contact that is pressed are left to a spare one.
    void meet(ContactInSpace<N, Real, P>* const contacts[], const Pair pairs[], const Encounters& e,
              Status statuses[], int count, Contact<N, Real, P>& spare) {
        set_pairs(this->pair, pairs, count);
        plane = plane_of(axes_of(contacts, e, count), e);
        motion = {e.penetration, plane.approach, plane.slide_x, plane.slide_y, e.step};
        set_statuses<Real, (P & viscous) != 0>(this->pair, motion, statuses, std::min(count, lanes));
        parted = LoadOf<Wide::Type>{};
        for (int k = 0; k < lanes; ++k) {
            const bool is_good = k < count && statuses[k] == Status::ok;
            pressed[k] = is_good && in_lane(motion.penetration, k) > 0.0;
            this->row.all[k] = pressed[k] ? contacts[k] : &spare;
            if (is_good) keep_axis(contacts[k]->axis, in_lane(plane.x, k));
            if (pressed[k]) continue;
            if (is_good) {
                Load load;
                part(*contacts[k], one_of(&motion, k), load);
                set_one(&parted, k, load);
            }
            spare = Contact<N, Real, P>{};
            spare.spacing = 1;
            set_one(&motion, k, Motion{0.0, 0.0, 0.0, 0.0, 1.0});
        }
    }

    void march(const Numbers<N, Real>& numbers) {
        for (int k = 0; k < lanes; ++k)
            if (pressed[k]) Stage<Wide::Type, N, Real, P>::march(k, numbers);
    }

    Actions settle(const Encounters& e) {
        LoadOf<Wide::Type> load;
        Stage<Wide::Type, N, Real, P>::settle(motion, load);
        for (int k = 0; k < lanes; ++k)
            if (!pressed[k]) set_one(&load, k, one_of(&parted, k));
        Actions action = act(load.normal, load.x, load.y, plane, e);
        action.friction = load.friction;
        action.viscosity = load.viscosity;
        return action;
    }
};

/// Bring a batch of contacts to the end of a step.
template <int N, class Real, unsigned P>
inline void advance_batch(ContactInSpace<N, Real, P>* const contacts[], const Pair pairs[],
                          const Encounters meetings[], Actions actions[], Status statuses[],
                          int count, const Numbers<N, Real>& numbers) {
    StageInSpace<N, Real, P> stages[together / lanes];
    Contact<N, Real, P> spare;
    const int rows = (count + lanes - 1) / lanes;
    for (int i = 0, k = 0; i < rows; ++i, k += lanes)
        stages[i].meet(contacts + k, pairs + k, meetings[i], statuses + k, count - k, spare);
    for (int i = 0; i < rows; ++i) stages[i].look(stages[i].motion);
    for (int i = 0; i < rows; ++i) stages[i].bound();
    for (int i = 0; i < rows; ++i) stages[i].march(numbers);
    for (int i = 0; i < rows; ++i) actions[i] = stages[i].settle(meetings[i]);
}

}  // namespace springs

/// Bring contacts in space to the end of a step and return what they do to the bodies; nothing
/// changes of one whose status is not ok, and it has no force. Several at once take less time than
/// one by one. Number k is in lane k % lanes of structure k / lanes; lanes that are left over hold
/// any encounter.
template <int N, class Real, unsigned P>
inline void advance(ContactInSpace<N, Real, P>* const contacts[], const Pair pairs[],
                    const Encounters meetings[], Actions actions[], Status statuses[], int count) {
    const springs::Numbers<N, Real> numbers;
    for (int k = 0; k < count; k += springs::together)
        springs::advance_batch(contacts + k, pairs + k, meetings + k / lanes, actions + k / lanes,
                               statuses + k, std::min(count - k, springs::together), numbers);
}

/// Bring many contacts of one pair to the end of a step, as `advance` does each. Returns ok, or the
/// first status that is not; such a contact keeps its memory and has no force.
template <int N, class Real, unsigned P>
inline Status advance(ContactInSpace<N, Real, P> contacts[], const Pair& pair,
                      const Encounter meetings[], Action actions[], std::size_t count) {
    constexpr std::size_t most = springs::together;
    ContactInSpace<N, Real, P>* which[most];
    Pair pairs[most];
    Encounters seen[most / lanes];
    Actions done[most / lanes];
    Status statuses[most], first = Status::ok;
    std::fill_n(pairs, most, pair);
    for (std::size_t from = 0; from < count; from += most) {
        const int now = static_cast<int>(std::min(count - from, most));
        for (int k = 0; k < static_cast<int>(most); ++k) {
            const std::size_t each = from + static_cast<std::size_t>(std::min(k, now - 1));
            which[k] = contacts + each;
            set_one(seen, k, meetings[each]);
        }
        advance(which, pairs, seen, done, statuses, now);
        for (int k = 0; k < now; ++k) {
            actions[from + static_cast<std::size_t>(k)] = one_of(done, k);
            if (first == Status::ok) first = statuses[k];
        }
    }
    return first;
}

/// Make the memory of a contact that of the second body's side, whose normal is the opposite one.
template <int N, class Real, unsigned P> void mirror(ContactInSpace<N, Real, P>& contact) {
    for (Real& each : contact.axis) each = -each;
    for (Real& each : contact.y) each = -each;
    if constexpr ((P & viscous) != 0) {
        contact.slide_y = -contact.slide_y;
        contact.damped_y = -contact.damped_y;
        if constexpr ((P & ledger) != 0) contact.drag_y = -contact.drag_y;
    }
    if constexpr (P != elastic) contact.shear_y = -contact.shear_y;
}
}  // namespace carom

#include "own_names.h"

#endif
