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

/// Enter the work of a step, and what of it is lost; the rest is stored.
template <class T, int N, class Real, unsigned P>
inline void enter(const Row<T, Contact<N, Real, P>>& row, const MotionOf<T>& m,
                  const LoadOf<T>& load) {
    using Kind = Contact<N, Real, P>;
    T twice = (load.x + row.get(&Kind::shear_x)) * m.slide_x +
              (load.y + row.get(&Kind::shear_y)) * m.slide_y;
    if constexpr ((P & viscous) != 0) twice += (load.normal + row.get(&Kind::normal)) * m.approach;
    row.keep(&Kind::stored,
             row.get(&Kind::stored) + (0.5 * m.step * twice - load.friction - load.viscosity));
}

/// Let go: what is still stored goes into the dashpots, or was rubbed off at last.
template <int N, class Real, unsigned P>
inline void part(Contact<N, Real, P>& c, const Motion& m, Load& load) {
    load = Load{};
    if constexpr ((P & ledger) != 0) {
        if (c.spacing > 0) enter(Row<double, Contact<N, Real, P>>{{&c}}, m, load);
        double& lost = (P & viscous) != 0 ? load.viscosity : load.friction;
        lost += c.stored;
    }
    c = Contact<N, Real, P>{};
}

/// A step of contacts in lanes of T, in four stages. In each of them many can be taken one after
/// the other: then the roots of one are not waited for by the next.
template <class T, int N, class Real, unsigned P> struct Stage {
    using Kind = Contact<N, Real, P>;
    using Narrow = Alike<T, Real>;

    Row<T, Kind> row;
    PairOf<T> pair;
    Now<T> now;
    Shared<Narrow> shared;
    Sums<T> sums;

    /// First: the lattice, and what all springs share.
    void look(const MotionOf<T>& motion) {
        fit_lattices(row, pair, motion);
        springs::look(row, pair, motion, now);
    }

    /// Second: where the contact ends.
    void bound() {
        now.edge = edge_of(row, now);
        find_ends<N>(now);
        const auto narrow = [&](Narrow Shared<Narrow>::*to, T Shared<T>::*from) {
            shared.*to = converted<Narrow>(now.*from);
        };
        using To = Shared<Narrow>;
        using From = Shared<T>;
        narrow(&To::depth, &From::depth);
        narrow(&To::edge, &From::edge);
        narrow(&To::least, &From::least);
        narrow(&To::most, &From::most);
        narrow(&To::moved_x, &From::moved_x);
        narrow(&To::moved_y, &From::moved_y);
        narrow(&To::first, &From::first);
        narrow(&To::inner, &From::inner);
        narrow(&To::bend, &From::bend);
        if constexpr ((P & viscous) != 0) {
            narrow(&To::limit, &From::limit);
            narrow(&To::fade, &From::fade);
            narrow(&To::drag_x, &From::drag_x);
            narrow(&To::drag_y, &From::drag_y);
        }
        sums = Sums<T>{};
    }

    /// Third: the springs of one of them.
    void march(int lane, const Numbers<N, Real>& numbers) {
        if (in_lane(pair.friction, lane) > 0.0 || (P & viscous) != 0)
            springs::march(*row.all[lane], numbers, shared, lane, in_lane(now.last, lane),
                           in_lane(pair.shear_retardation, lane) > 0.0, sums);
    }

    /// Last: the load.
    void settle(const MotionOf<T>& motion, LoadOf<T>& load) {
        const T none{}, most = larger(now.root * (now.limit - now.edge * (1.0 / 3.0)), none);
        if constexpr ((P & viscous) != 0) {  // at the edge itself only dashpots bear
            const T rest = now.rest * cut(now.drag_x, now.drag_y, larger(now.limit - now.edge, none));
            sums.x += rest * now.drag_x;
            sums.y += rest * now.drag_y;
        }
        const T all = 2.0 * pair.modulus * row.get(&Kind::spacing) * now.unit;
        T scale = all * pair.friction;
        load.friction = load.viscosity = none;
        if constexpr ((P & ledger) != 0) {
            const T energy = scale * now.unit * pair.friction / pair.stiffness_ratio;
            load.friction = energy * sums.friction;
            load.viscosity = energy * sums.viscosity;
        }
        const auto slides = sums.x * sums.x + sums.y * sums.y > most * most;  // by rounding
        if (any(slides)) scale = slides ? scale * cut(sums.x, sums.y, most) : scale;
        load.normal = all * most;
        load.x = scale * sums.x;
        load.y = scale * sums.y;
        keep(all, motion, load);
    }

    /// Keep what the next step needs of this one.
    void keep(const T& scale, const MotionOf<T>& motion, LoadOf<T>& load) {
        row.keep(&Kind::edge, now.edge);
        if constexpr (P == (viscous | ledger)) {
            row.keep(&Kind::limit, now.limit);
            row.keep(&Kind::drag_x, now.drag_x);
            row.keep(&Kind::drag_y, now.drag_y);
            // dashpots in compression: tau d'^2 of every spring
            const T power = scale * now.excess * now.root * now.approach * now.unit;
            load.viscosity += 0.5 * motion.step * (power + row.get(&Kind::power));
            row.keep(&Kind::power, power);
        }
        if constexpr ((P & ledger) != 0) enter(row, motion, load);
        if constexpr (P != elastic) {
            row.keep(&Kind::normal, held<Real>(load.normal));
            row.keep(&Kind::shear_x, held<Real>(load.x));
            row.keep(&Kind::shear_y, held<Real>(load.y));
        }
    }
};

}  // namespace springs

/// Bring a contact to the end of a step and return its load; nothing changes unless all is ok.
template <int N, class Real, unsigned P>
inline Status advance(Contact<N, Real, P>& contact, const Pair& pair, const Motion& motion,
                      Load& load) {
    springs::Stage<double, N, Real, P> stage;
    stage.row.all[0] = &contact;
    springs::set_pairs(stage.pair, &pair, 1);
    Status status;
    springs::set_statuses<Real, (P & viscous) != 0>(stage.pair, motion, &status, 1);
    if (status != Status::ok) return status;
    if (motion.penetration > 0.0) {
        stage.look(motion);
        stage.bound();
        stage.march(0, springs::Numbers<N, Real>{});
        stage.settle(motion, load);
    } else {
        springs::part(contact, motion, load);
    }
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
