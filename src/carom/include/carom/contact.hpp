// carom/contact.hpp: the exact contact of spheres, step by step, for programs that move particles.
//
// SPDX-License-Identifier: BSD-3-Clause
//
// C++17, nothing to link, no allocation. Of every contact keep a Contact, all zeros before the
// first touch, and call `advance` in each step with the motion of the contact point:
//
//     carom::Pair pair{modulus, radius, stiffness_ratio, friction, mass};
//     carom::Contact<> contact{};
//     carom::Load load{};
//     carom::advance(contact, pair, {penetration, approach, slide_x, slide_y, step}, load);
//
// It is the impact of Maw, Barber & Fawcett (1976) in the limit of small steps and many springs, of
// second order in both; with losses that of Kelvin & Voigt's solid. Contacts in space, with bodies
// that turn, are those of carom/contact_in_space.hpp. Any coherent units.
#ifndef CAROM_CONTACT_HPP
#define CAROM_CONTACT_HPP

#include "marching.hpp"

#include "own_names.h"

namespace carom {
namespace springs {

/// Keep what the next step needs of this one.
template <int N, class Real, unsigned P>
inline void keep(Contact<N, Real, P>& c, const Now& now, double edge, double scale, const Motion& m,
                 Load& load) {
    c.edge = static_cast<Real>(edge);
    if constexpr ((P & viscous) != 0) {
        c.limit = static_cast<Real>(now.limit);
        c.drag_x = static_cast<Real>(now.drag_x);
        c.drag_y = static_cast<Real>(now.drag_y);
        if constexpr ((P & ledger) != 0) {  // dashpots in compression: tau d'^2 of every spring
            const double power = scale * now.excess * std::sqrt(edge) * now.approach * now.unit;
            load.viscosity += 0.5 * m.step * (power + c.power);
            c.power = static_cast<Real>(power);
        }
    }
}

/// Enter the work of a step, and what of it is lost; the rest is stored.
template <int N, class Real, unsigned P>
inline void enter(Contact<N, Real, P>& c, const Motion& m, Load& load) {
    if constexpr ((P & ledger) != 0) {
        double twice = (load.x + c.shear_x) * m.slide_x + (load.y + c.shear_y) * m.slide_y;
        if constexpr ((P & viscous) != 0) twice += (load.normal + c.normal) * m.approach;
        c.stored += static_cast<Real>(0.5 * m.step * twice - load.friction - load.viscosity);
        c.normal = static_cast<Real>(load.normal);
        c.shear_x = static_cast<Real>(load.x);
        c.shear_y = static_cast<Real>(load.y);
    }
}

/// Let go: what is still stored goes into the dashpots, or was rubbed off at last.
template <int N, class Real, unsigned P>
inline void part(Contact<N, Real, P>& c, const Motion& m, Load& load) {
    if constexpr ((P & ledger) != 0) {
        if (c.spacing > 0) enter(c, m, load);
        double& lost = (P & viscous) != 0 ? load.viscosity : load.friction;
        lost += c.stored;
    }
    c = Contact<N, Real, P>{};
}

/// What a step of a contact knows between its three stages. In each of them several contacts can
/// be taken one after the other: then the roots of one are not waited for by the next.
struct Stage {
    Now now;
    double edge, root, scale;  // s at the edge and its root, force of a unit
    Sums sums;
};

/// First: the lattice, and what all springs share.
template <int N, class Real, unsigned P>
inline void prepare(Contact<N, Real, P>& c, const Pair& pair, const Motion& m, Fading& fading,
                    Stage& stage) {
    if (!(c.spacing > 0)) begin(c, pair, m);
    fit_lattice(c, pair, m);
    look(c, pair, m, fading, stage.now);
    stage.edge = edge_of(c, stage.now);
    stage.root = std::sqrt(stage.edge);
    stage.scale = 2.0 * pair.modulus * double(c.spacing) * stage.now.unit;
}

/// Second: the springs.
template <int N, class Real, unsigned P>
inline void march(Contact<N, Real, P>& c, const Pair& pair, const Numbers<N, Real>& numbers,
                  Stage& stage) {
    stage.sums = Sums{};
    if (pair.friction > 0.0 || (P & viscous) != 0)
        stage.sums = march(c, numbers, stage.now, stage.edge, pair.viscous_shear);
}

/// Last: the load.
template <int N, class Real, unsigned P>
inline void settle(Contact<N, Real, P>& c, const Pair& pair, const Motion& m, Stage& stage,
                   Load& load) {
    const Now& now = stage.now;
    load = Load{};
    Sums& sums = stage.sums;
    const double most = larger(stage.root * (now.limit - stage.edge * (1.0 / 3.0)), 0.0);
    const double scale = stage.scale * pair.friction;
    trim(c, now, stage.edge, stage.root, sums);
    if (sums.x * sums.x + sums.y * sums.y > most * most) {  // by rounding
        const double part = cut(sums.x, sums.y, most);
        sums.x *= part;
        sums.y *= part;
    }
    load.normal = stage.scale * most;
    load.x = scale * sums.x;
    load.y = scale * sums.y;
    if constexpr ((P & ledger) != 0) {
        const double energy = scale * now.unit * pair.friction / pair.stiffness_ratio;
        load.friction = energy * sums.friction;
        load.viscosity = energy * sums.viscosity;
    }
    keep(c, now, stage.edge, stage.scale, m, load);
    enter(c, m, load);
}

}  // namespace springs

/// Bring a contact to the end of a step and return its load; nothing changes unless all is ok.
template <int N, class Real, unsigned P>
inline Status advance(Contact<N, Real, P>& contact, const Pair& pair, const Motion& motion,
                      Load& load) {
    const Status status = status_of<Real>(pair, motion);
    if (status != Status::ok) return status;
    load = Load{};
    if (motion.penetration <= 0.0) {
        springs::part(contact, motion, load);
        return status;
    }
    springs::Stage stage;
    springs::Fading fading;
    springs::prepare(contact, pair, motion, fading, stage);
    springs::march(contact, pair, springs::Numbers<N, Real>{}, stage);
    springs::settle(contact, pair, motion, stage, load);
    return status;
}

/// Bring many contacts of one pair to the end of a step. Returns ok, or the first status that is
/// not; such a contact and its load stay as they were.
template <int N, class Real, unsigned P>
inline Status advance(Contact<N, Real, P> contacts[], const Pair& pair, const Motion motions[],
                      Load loads[], std::size_t count) {
    Status first = Status::ok;
    for (std::size_t k = 0; k < count; ++k) {
        const Status status = advance(contacts[k], pair, motions[k], loads[k]);
        if (first == Status::ok) first = status;
    }
    return first;
}

}  // namespace carom

#include "own_names.h"

#endif
