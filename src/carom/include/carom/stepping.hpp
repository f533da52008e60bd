// carom/stepping.hpp: what all springs of a contact share in a step.
//
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CAROM_STEPPING_HPP
#define CAROM_STEPPING_HPP

#include "memory.hpp"

#include "own_names.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace springs {

/// What all springs of a step share, in spacing^2/R* (and mu/kappa along the contact).
template <class T> struct Shared {
    T depth;  ///< d at the end of the step
    T least, most;       ///< what of its share in the step a spring has: depth - s, if d rises
    T moved_x, moved_y;  ///< how far the bodies slid, for each share
    T first, inner, bend;  ///< weights of the middle spring, and more for the last two
    T limit, edge;         ///< D = d + tau d', s at the edge
    T fade;  ///< part of a deflection that a free spring loses: 1 - exp(-dt/tau)
    T drag_x, drag_y;  ///< tau q'
};

/// And what of it they need not know, of contacts in lanes of T.
template <class T> struct Now : Shared<T> {
    T unit;           ///< spacing^2/R*
    T rises, before;  ///< what d has grown by, d before
    T excess, approach;  ///< tau d', d' at the end of the step, of viscous bodies
    T root, rest;     ///< b, and the weight of the edge itself
    Alike<T, int> last;  ///< the last spring within
};

/// Return the mean of b around the end of a step over b there, the bodies approaching by `half`
/// in half a step: dashpots bear so much more while b goes like the root of the time. The first
/// step counts from the touch. No difference of powers is taken: they may be equal to rounding.
template <class T> inline T mean_at_end(const T& depth, const T& before, const T& half) {
    const T one = T{} + 1.0, on = half > 0.0 ? half : one;
    const T back = smaller(before > 0.0 ? on : 2.0 * on, depth);
    const T to = springs::root(depth + on), from = springs::root(depth - back);
    const T there = springs::root(larger(depth, 1e-40 * on));
    const T mean = (back + on) * (to * (to + from) + from * from) / (3.0 * on * (to + from) * there);
    return half > 0.0 ? mean : one;
}

/// Return what fades in a step; it is computed anew where the step is another than before.
template <class T, int N, class Real, unsigned P>
inline T fade_of(const Row<T, Contact<N, Real, P>>& row, const T& steps) {
    using Kind = Contact<N, Real, P>;
    const auto now = converted<Alike<T, Real>>(steps);
    if (any(converted<T>(now) != row.get(&Kind::steps)))
        for (int k = 0; k < width<T>; ++k) {
            row.all[k]->steps = in_lane(now, k);
            row.all[k]->fade = static_cast<Real>(-std::expm1(-in_lane(steps, k)));
        }
    return row.get(&Kind::fade);
}

/// Velocities at the end of a step, which dashpots have there.
template <class T> struct Ends {
    T approach, slide_x, slide_y;
};

/// How many times as fast as one pair alone the dashpots of a packing slow its bodies, at most.
/// Velocities stay bounded at any loss if k dt^2/m* + 4/crowd, summed by the geometry of the packing,
/// is below 4: among equal spheres, closely packed, up to k dt^2/m* = 0.1 from 12 on.
constexpr double crowd = 16.0;

/// What is left of a velocity to which dashpots are applied, and of what they took a step ago.
template <class T> struct Braking {
    T left, again;
};

/// Return 1/(1 + S g) and S/(1 + S g). S is by how much more than the contact's own dashpot all of
/// them slow its bodies: 1 if nothing else acts on these, more where others do. It is told by squares
/// of velocities: gained by the forces of others and by its own in half a step, and those themselves,
/// of which both are rounding if they are so small.
template <class T>
inline Braking<T> brake(const T& by_others, const T& by_own, const T& speed, const T& damping) {
    const T all = by_others + by_own + 1e-12 * speed + 1e-300;
    const T crowded = all + (crowd - 1.0) * smaller(4.0 * by_others, all);  // S times as much
    const T whole = 1.0 / (all + crowded * damping);
    return {whole * all, whole * crowded};
}

/// Return velocities at the end of a step, for a contact of this radius.
///
/// They follow from those of its middle, v, and the acceleration of the step before, but for what
/// dashpots do: these take g e in a step, g = k tau dt/m*, and bodies that many of them slow would be
/// thrown back by what they did a step ago. So what they change by since counts at once,
///
///     e = v + (v - v_before)/2 - S/2 (g e - g e_before),
///
/// which is of second order for any S, and stable where S is as large as all dashpots of the bodies
/// demand (a W-method; Steihaug & Wolfbrandt 1979).
template <class T, int N, class Real, unsigned P>
inline Ends<T> ends_of(const Row<T, Contact<N, Real, P>>& row, const PairOf<T>& pair,
                       const MotionOf<T>& m, const T& radius) {
    using Kind = Contact<N, Real, P>;
    const auto square = [](const T& each) { return each * each; };
    const T per_force = m.step / pair.mass, half = 0.5 * per_force;

    // gained in half a step: in all, and by this contact
    const T approach = 0.5 * (m.approach - row.get(&Kind::approach));
    const T slide_x = 0.5 * (m.slide_x - row.get(&Kind::slide_x));
    const T slide_y = 0.5 * (m.slide_y - row.get(&Kind::slide_y));
    const T own = half * row.get(&Kind::normal);
    const T own_x = lever * half * row.get(&Kind::shear_x);
    const T own_y = lever * half * row.get(&Kind::shear_y);

    const T damping = damping_of(pair, radius, per_force);
    const T damping_aside = shear_damping_of(pair, radius, per_force);
    const Braking<T> along = brake(square(approach + own), square(own), square(m.approach), damping);
    const Braking<T> aside =
        brake(square(slide_x + own_x) + square(slide_y + own_y), square(own_x) + square(own_y),
              square(m.slide_x) + square(m.slide_y), damping_aside);

    Ends<T> end;
    end.approach = along.left * (m.approach + approach) + along.again * row.get(&Kind::damped);
    end.slide_x = aside.left * (m.slide_x + slide_x) + aside.again * row.get(&Kind::damped_x);
    end.slide_y = aside.left * (m.slide_y + slide_y) + aside.again * row.get(&Kind::damped_y);

    row.keep(&Kind::damped, damping * end.approach);
    row.keep(&Kind::damped_x, damping_aside * end.slide_x);
    row.keep(&Kind::damped_y, damping_aside * end.slide_y);
    row.keep(&Kind::approach, m.approach);
    row.keep(&Kind::slide_x, m.slide_x);
    row.keep(&Kind::slide_y, m.slide_y);
    return end;
}

/// Find what all springs share in a step.
template <class T, int N, class Real, unsigned P>
inline void look(const Row<T, Contact<N, Real, P>>& row, const PairOf<T>& pair,
                 const MotionOf<T>& m, Now<T>& now) {
    using Kind = Contact<N, Real, P>;
    const T none{}, one = none + 1.0, spacing = row.get(&Kind::spacing), square = spacing * spacing;
    const T per_unit = pair.radius / square;
    now.unit = square / pair.radius;
    now.rises = m.approach * m.step * per_unit;
    now.depth = now.limit = m.penetration * per_unit;
    const auto is_rising = now.rises > 1e-12 * (now.depth + 1.0);
    now.least = is_rising ? none : one;
    now.most = is_rising ? now.rises : one;
    const T friction = larger(pair.friction, none + 1.0 / largest);
    const T slope = pair.friction > 0.0 ? per_unit * pair.stiffness_ratio / friction : none;
    const T moved = slope * m.step / now.most;
    now.moved_x = moved * m.slide_x;
    now.moved_y = moved * m.slide_y;
    if constexpr ((P & viscous) != 0) {
        const auto losing = pair.retardation > 0.0;
        const Ends<T> end = ends_of(row, pair, m, spacing * root(now.depth));
        const T approach = end.approach * per_unit;
        const T half = losing ? 0.5 * approach * m.step : none;
        now.before = now.depth - now.rises;
        const T mean = mean_at_end(now.depth, now.before, half);
        now.approach = losing ? mean * approach : none;
        now.excess = smaller(pair.retardation * now.approach, none + farthest<Real>);
        now.limit = larger(now.limit + now.excess, none);
        const T all = none + 1e3;  // or more retardation times: nothing is left of a deflection
        now.fade = fade_of(row, losing ? smaller(m.step / pair.retardation, all) : all);
        const T drag = slope * pair.shear_retardation * mean;
        now.drag_x = drag * end.slide_x;
        now.drag_y = drag * end.slide_y;
        shorten<Real>(now.drag_x, now.drag_y, one);
    }
    shorten<Real>(now.moved_x, now.moved_y, now.most);
}

/// Return s where surfaces meet that overlap by `here` at the edge, free springs keeping this part.
template <int N, class Real, unsigned P>
inline double grown_edge(const Contact<N, Real, P>& c, double depth, double edge, double here,
                         double keep) {
    for (int k = static_cast<int>(std::sqrt(edge)); here > 0.0; ++k) {
        const double s = double(k + 1) * (k + 1);
        const double there = depth - s - (k + 1 < N ? double(c.pressed[k + 1]) * keep : 0.0);
        if (there < 0.0) return edge + (s - edge) * here / (here - there);
        edge = s;
        here = there;
    }
    return edge;
}

/// Return s at the edge, rounded as it is kept: it grows to where surfaces meet, and not beyond
/// where they press.
template <class T, int N, class Real, unsigned P>
inline T edge_of(const Row<T, Contact<N, Real, P>>& row, const Now<T>& now) {
    if constexpr ((P & viscous) == 0) {
        return now.depth;
    } else {
        const T none{}, one = none + 1.0, edge = row.get(&Contact<N, Real, P>::edge);
        const T was = now.before - edge, keep = one - now.fade;
        const T here = was > 0.0 ? now.rises + was * now.fade : now.depth - edge;
        // seldom it grows beyond the next spring
        const auto inner = converted<Alike<T, int>>(smaller(root(edge), none + (N - 1.0)));
        const T next = converted<T>(inner) + 1.0, s = next * next;
        const T pressed = converted<T>(by_lane<T, Real>([&](int k) {
            const int n = in_lane(inner, k) + 1;
            return n < N ? row.all[k]->pressed[n] : Real(0);
        }));
        const T there = now.depth - s - pressed * keep;
        const auto grows = (now.limit >= edge) & (here > 0.0), further = grows & (there >= 0.0);
        T grown = edge + (grows ? (s - edge) * here / (grows ? here - there : one) : none);
        for (int k = 0; any(further) && k < width<T>; ++k)
            if (in_lane(further, k))
                set_lane(grown, k, grown_edge(*row.all[k], in_lane(now.depth, k), in_lane(edge, k),
                                              in_lane(here, k), in_lane(keep, k)));
        return converted<T>(converted<Alike<T, Real>>(smaller(grown, now.limit)));
    }
}

/// Find how the sum over springs ends. From the last one on q is linear in s; at that spring the
/// sum lacks -q'(x)/12, the slope of q(s) being that from the spring before it to the edge.
template <int N, class T> inline void find_ends(Now<T>& now) {
    const T none{}, tiny = none + 1e-300, edge = now.edge;
    now.root = springs::root(edge);
    T last = converted<T>(converted<Alike<T, int>>(smaller(larger(now.root, none), none + (N - 1.0))));
    last = ((last > 0.0) & (last * last >= edge)) ? last - 1.0 : last;  // it is to be inside
    const T before = larger(last - 1.0, none), width = now.root - last;
    const T falling = width * (2.0 * now.root + last) / (3.0 * larger(now.root + last, tiny));
    now.bend = last / (6.0 * larger(edge - before * before, tiny));
    now.rest = width - falling - now.bend;
    now.first = last > 0.0 ? none + 0.5 : falling;
    now.inner = last > 0.0 ? falling - 0.5 : none;
    now.last = converted<Alike<T, int>>(last);
}

}  // namespace springs
}  // namespace carom

#include "own_names.h"

#endif
