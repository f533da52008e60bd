// carom/marching.hpp: the springs of a contact, a register full after the other.
//
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CAROM_MARCHING_HPP
#define CAROM_MARCHING_HPP

#include "lanes.hpp"
#include "stepping.hpp"

#include "own_names.h"

#include <algorithm>
#include <limits>

namespace carom {
namespace springs {

/// What a step makes of all springs: their force as an integral over x/h, and what they lose.
struct Sums {
    double x, y, friction, viscosity;
};

/// Constants in each lane of a register, made once for many contacts.
template <int N, class Real> struct Numbers {
    using L = Lanes<Real, N>;
    typename L::Type zero = L::fixed(0), half = L::fixed(Real(0.5)), one = L::fixed(1);
    typename L::Type tiny = L::fixed(std::numeric_limits<Real>::min());
    typename L::Type faint = L::of(1e-20), steep = L::of(1e20);
};

/// The springs of a step: what they share, in each lane of a register, and what they add up to.
template <int N, class Real, unsigned P> struct March {
    using L = Lanes<Real, N>;
    using V = typename L::Type;
    static constexpr Places<N, Real> places{};

    V zero, half, one, tiny, faint, steep;
    V depth, limit, rim, fade, faded, least, full, moved_x, moved_y, drag_x, drag_y;
    V along{}, across{}, rubbed{}, dragged{};
    bool viscous_shear, turns;

    March(const Numbers<N, Real>& n, const Now& now, double edge, bool sheared)
        : zero(n.zero), half(n.half), one(n.one), tiny(n.tiny), faint(n.faint), steep(n.steep),
          depth(L::of(now.depth)), limit(L::of(now.limit)), rim(L::of(edge)), fade(L::of(now.fade)),
          least(L::of(now.least)), full(L::of(now.most)), moved_x(L::of(now.moved_x)),
          moved_y(L::of(now.moved_y)), drag_x(L::of(now.drag_x)), drag_y(L::of(now.drag_y)),
          viscous_shear(sheared), turns((P & viscous) == 0 || !sheared || !(now.fade < 1.0)) {
        faded = turns ? one : fade;
    }

    /// Make nothing of what has died away: denormal numbers would last, and take long.
    V settled(V v) const { return (v + faint) - faint; }

    /// Factor that cuts vectors back to lengths, and one over the length that they had.
    V cut(V x, V y, V most, V& inverse) const {
        inverse = one / root(larger(x * x + y * y, tiny));
        return smaller(most * inverse, one);
    }

    /// Bring the springs from k on to the end of the step.
    void take(Contact<N, Real, P>& c, int k) {
        const V s = L::load(places.square + k), x0 = L::load(c.x + k), y0 = L::load(c.y + k);
        // what is touched within the step goes only the rest of its way
        const V pressed = depth - s, share = smaller(larger(pressed, least), full);
        V bearable = larger(pressed, zero), most = bearable, free_x = x0, free_y = y0, inverse;
        if constexpr ((P & viscous) != 0) {
            const V inside = (rim - s) * steep;  // beyond the edge springs are free
            // by what fades: what is kept is one to rounding where steps are short
            const V held = L::load(c.pressed + k), less = held * fade;
            const V is = settled(larger(pressed, held - less));
            const V grown = (is - held) + less;
            L::store(c.pressed + k, is);
            bearable = larger(smaller(limit - s, inside), zero);
            most = viscous_shear ? larger(smaller(grown, inside), zero) : bearable;
            free_x = x0 * faded;
            free_y = y0 * faded;
        }
        const V to_x = free_x + share * moved_x, to_y = free_y + share * moved_y;
        const V part = cut(to_x, to_y, most, inverse);
        V x = part * to_x, y = part * to_y;
        // a cut turns springs too little, by half of what it takes of their part aside
        if (turns) {
            const V less = smaller(part, half) * (one - part);
            const V ahead = part + less * (free_x * to_x + free_y * to_y) * inverse * inverse;
            x = ahead * to_x - less * free_x;
            y = ahead * to_y - less * free_y;
        }
        V bears_x = x, bears_y = y;
        if constexpr ((P & viscous) != 0) {  // with what dashpots bear
            x = settled(x0 + (x - free_x));
            y = settled(y0 + (y - free_y));
            bears_x = x + drag_x;
            bears_y = y + drag_y;
            const V bears = cut(bears_x, bears_y, bearable, inverse);
            bears_x *= bears;
            bears_y *= bears;
        }
        if constexpr ((P & ledger) != 0)
            book(c, k, x, y, bears_x, bears_y, share * moved_x, share * moved_y);
        L::store(c.x + k, x);
        L::store(c.y + k, y);
        const V weight = L::load(places.weight + k);
        along += weight * bears_x;
        across += weight * bears_y;
    }

    /// Enter what springs lose by which the bodies slid so far.
    void book(const Contact<N, Real, P>& c, int k, V x, V y, V bears_x, V bears_y, V slid_x,
              V slid_y) {
        const V x0 = L::load(c.x + k), y0 = L::load(c.y + k), weight = L::load(places.weight + k);
        V bore_x = x0, bore_y = y0;
        if constexpr ((P & viscous) != 0) {
            const V s = L::load(places.square + k);
            const V inside = smaller(L::of(c.limit) - s, (L::of(c.edge) - s) * steep);
            bore_x = x0 + L::of(c.drag_x);
            bore_y = y0 + L::of(c.drag_y);
            V inverse;
            const V bore = cut(bore_x, bore_y, larger(inside, zero), inverse);
            bore_x *= bore;
            bore_y *= bore;
        }
        const V mean_x = half * (bears_x + bore_x), mean_y = half * (bears_y + bore_y);
        const V went_x = x - x0, went_y = y - y0;
        rubbed += weight * (mean_x * (slid_x - went_x) + mean_y * (slid_y - went_y));
        dragged += weight * ((mean_x - half * (x + x0)) * went_x +
                             (mean_y - half * (y + y0)) * went_y);
    }
};

/// Bring all springs to the end of the step.
template <int N, class Real, unsigned P>
inline Sums march(Contact<N, Real, P>& c, const Numbers<N, Real>& numbers, const Now& now, double edge,
                  bool viscous_shear) {
    using All = March<N, Real, P>;
    All all(numbers, now, edge, viscous_shear);
    // elastic springs beyond are at rest
    const Real reach = larger(c.edge, static_cast<Real>(edge));
    bool more = true;
    for (int k = 0; k < N && more; k += All::L::count) {
        more = (P & viscous) != 0 || All::places.square[k + All::L::count - 1] < reach;
        all.take(c, k);
    }
    Sums sums{};
    sums.x = All::L::total(all.along);
    sums.y = All::L::total(all.across);
    if constexpr ((P & ledger) != 0) {
        sums.friction = All::L::total(all.rubbed);
        sums.viscosity = All::L::total(all.dragged);
    }
    return sums;
}

/// End the sum at the edge. From the last spring on q is linear in s; at that spring the sum lacks
/// -q'(x)/12, the slope of q(s) being that from the spring before it to the edge.
template <int N, class Real, unsigned P>
inline void trim(const Contact<N, Real, P>& c, const Now& now, double edge, double beta,
                 Sums& sums) {
    if (!(beta > 0.0)) return;
    int last = std::min(static_cast<int>(beta), N - 1);
    if (last > 0 && !(double(last) * last < edge)) --last;  // it is not inside
    const int before = std::max(last - 1, 0);
    const double width = beta - last;
    const double inner = width * (2.0 * beta + last) / (3.0 * (beta + last));  // falling to zero
    const double bend = last / (6.0 * (edge - double(before) * before));
    if (last == 0) sums.x = sums.y = 0.0;  // nothing is taken from what is equal to rounding
    const double less = inner - (last == 0 ? 0.0 : 0.5);
    const auto add = [&](double weight, double x, double y, double limit) {
        if constexpr ((P & viscous) != 0)
            weight *= cut(x += now.drag_x, y += now.drag_y, larger(limit, 0.0));
        sums.x += weight * x;
        sums.y += weight * y;
    };
    add(less, c.x[last], c.y[last], now.limit - double(last) * last);
    add(bend, c.x[before], c.y[before], now.limit - double(before) * before);
    if constexpr ((P & viscous) != 0) add(width - inner - bend, 0.0, 0.0, now.limit - edge);
}

}  // namespace springs
}  // namespace carom

#include "own_names.h"

#endif
