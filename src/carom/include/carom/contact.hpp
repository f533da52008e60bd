// carom/contact.hpp: the exact contact of spheres, step by step, for programs that move particles.
//
// SPDX-License-Identifier: BSD-3-Clause
//
// C++17, nothing to link, no allocation. Of every contact keep a Contact, all zeros before the
// first touch, and call `advance` in each step with the motion of the contact point:
//
//     carom::Pair pair{modulus, radius, stiffness_ratio, friction, mass};
//     carom::Contact<32> contact{};
//     carom::Load load{};
//     carom::advance(contact, pair, {penetration, approach, slide_x, slide_y, step}, load);
//
// It is the impact of Maw, Barber & Fawcett (1976) in the limit of small steps and many springs, of
// second order in both; with losses that of Kelvin & Voigt's solid. Contacts in space, with bodies
// that turn, are those of carom/contact_in_space.hpp. Any coherent units.
#ifndef CAROM_CONTACT_HPP
#define CAROM_CONTACT_HPP

#include "stepping.hpp"

namespace carom {
namespace springs {

/// Keep what the next step needs of this one.
template <int N, class Real, unsigned P>
void keep(Contact<N, Real, P>& c, const Now& now, double edge, double scale, const Motion& m,
          Load& load) {
    c.edge = static_cast<Real>(edge);
    if constexpr ((P & viscous) != 0) {
        c.limit = static_cast<Real>(now.limit);
        c.drag_x = static_cast<Real>(now.drag_x);
        c.drag_y = static_cast<Real>(now.drag_y);
        if constexpr ((P & ledger) != 0) {  // dashpots in compression: tau d'^2 of every spring
            const double power = scale * (now.limit - now.depth) * std::sqrt(edge) * now.approach;
            load.viscosity += 0.5 * m.step * (power + c.power);
            c.power = static_cast<Real>(power);
        }
    }
}

/// Enter the work of a step, and what of it is lost; the rest is stored.
template <int N, class Real, unsigned P>
void enter(Contact<N, Real, P>& c, const Motion& m, Load& load) {
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
void part(Contact<N, Real, P>& c, const Motion& m, Load& load) {
    if constexpr ((P & ledger) != 0) {
        if (c.spacing > 0) enter(c, m, load);
        double& lost = (P & viscous) != 0 ? load.viscosity : load.friction;
        lost += c.stored;
    }
    c = Contact<N, Real, P>{};
}

}  // namespace springs

/// Bring a contact to the end of a step and return its load; nothing changes unless all is ok.
template <int N, class Real, unsigned P>
Status advance(Contact<N, Real, P>& contact, const Pair& pair, const Motion& motion, Load& load) {
    if (!is_good(pair)) return Status::bad_pair;
    if (!is_good(motion, pair.radius)) return Status::bad_motion;
    load = Load{};
    if (motion.penetration <= 0.0) {
        springs::part(contact, motion, load);
        return Status::ok;
    }
    if (!(contact.spacing > 0)) springs::begin(contact, pair, motion);
    springs::fit_lattice(contact, pair, motion);
    const springs::Now now = springs::now_of(contact, pair, motion);
    const double edge = springs::edge_of(contact, now), beta = std::sqrt(edge);
    const double scale = 2.0 * pair.modulus * double(contact.spacing) * now.unit;
    load.normal = scale * std::max(beta * (now.limit - edge / 3.0), 0.0);
    if (pair.friction > 0.0 || (P & viscous) != 0) {
        springs::Sums sums = springs::march(contact, now, edge, pair.viscous_shear);
        springs::trim(contact, now, edge, sums);
        const double most = pair.friction * load.normal;  // but for rounding it holds already
        const double x = scale * pair.friction * sums.x, y = scale * pair.friction * sums.y;
        const double part = springs::cut(x, y, most);
        load.x = part * x;
        load.y = part * y;
        const double slip = now.unit * pair.friction / pair.stiffness_ratio;
        const double energy = scale * pair.friction * slip;
        load.friction = energy * sums.friction;
        load.viscosity = energy * sums.viscosity;
    }
    springs::keep(contact, now, edge, scale, motion, load);
    springs::enter(contact, motion, load);
    return Status::ok;
}

}  // namespace carom

#endif
