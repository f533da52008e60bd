// carom/marching.hpp: the springs of a contact, a register full after the other.
//
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CAROM_MARCHING_HPP
#define CAROM_MARCHING_HPP

#include "lanes.hpp"
#include "stepping.hpp"

#include "own_names.h"

#include <limits>

namespace carom {
namespace springs {

/// What a step makes of all springs: their force as an integral over x/h, and what they lose.
template <class T> struct Sums {
    T x, y, friction, viscosity;
};

/// Constants in each lane of a register, made once for many contacts.
template <int N, class Real> struct Numbers {
    using L = Lanes<Real, N>;
    typename L::Type zero = L::fixed(0), half = L::fixed(Real(0.5)), one = L::fixed(1);
    typename L::Type tiny = L::fixed(std::numeric_limits<Real>::min());
    typename L::Type faint = L::of(1e-20);
};

/// The springs of a step: what they share, in each lane of a register, and what they add up to.
template <int N, class Real, unsigned P> struct March {
    using L = Lanes<Real, N>;
    using V = typename L::Type;
    static constexpr Places<N, Real> places{};

    V zero, half, one, tiny, faint;
    V depth, least, full, moved_x, moved_y, first, inner, bend;
    V limit, rim, fade, faded, drag_x, drag_y;
    V along{}, across{}, rubbed{}, dragged{};
    const Real *last, *before;  ///< where the line of zeros has its one for them
    bool viscous_shear, turns;

    template <class T>
    March(const Numbers<N, Real>& n, const Shared<T>& now, int lane, int end, bool sheared)
        : zero(n.zero), half(n.half), one(n.one), tiny(n.tiny), faint(n.faint),
          depth(L::of(in_lane(now.depth, lane))), least(L::of(in_lane(now.least, lane))),
          full(L::of(in_lane(now.most, lane))), moved_x(L::of(in_lane(now.moved_x, lane))),
          moved_y(L::of(in_lane(now.moved_y, lane))), first(L::of(in_lane(now.first, lane))),
          inner(L::of(in_lane(now.inner, lane))), bend(L::of(in_lane(now.bend, lane))),
          last(places.single + N - end), before(end > 0 ? last + 1 : last), viscous_shear(sheared),
          turns(true) {
        if constexpr ((P & viscous) != 0) {
            limit = L::of(in_lane(now.limit, lane));
            rim = L::of(in_lane(now.edge, lane));
            fade = L::of(in_lane(now.fade, lane));
            drag_x = L::of(in_lane(now.drag_x, lane));
            drag_y = L::of(in_lane(now.drag_y, lane));
            turns = !sheared || !(in_lane(now.fade, lane) < 1);
            faded = turns ? one : fade;
        }
    }

    /// Weights in the sum over x >= 0: all one but for the first and the last ones.
    V weight(int k) const {
        return L::load(places.aside + k) + first * L::load(places.single + N + k) +
               inner * L::load(last + k) + bend * L::load(before + k);
    }

    /// Make nothing of what has died away: denormal numbers would last, and take long.
    V settled(V v) const { return (v + faint) - faint; }

    /// Factor that cuts vectors back to lengths.
    V cut(V x, V y, V most) const {
        return most / larger(root(larger(x * x + y * y, tiny)), most);
    }

    /// Bring the springs from k on to the end of the step.
    void take(Contact<N, Real, P>& c, int k) {
        const V s = L::load(places.square + k), x0 = L::load(c.x + k), y0 = L::load(c.y + k);
        // what is touched within the step goes only the rest of its way
        const V pressed = depth - s, share = smaller(larger(pressed, least), full);
        V bearable = larger(pressed, zero), most = bearable, free_x = x0, free_y = y0;
        if constexpr ((P & viscous) != 0) {
            const auto inside = s < rim;  // beyond the edge springs are free
            // by what fades: what is kept is one to rounding where steps are short
            const V held = L::load(c.pressed + k), less = held * fade;
            const V is = settled(larger(pressed, held - less));
            const V grown = (is - held) + less;
            L::store(c.pressed + k, is);
            bearable = inside ? larger(limit - s, zero) : zero;
            most = viscous_shear ? (inside ? larger(grown, zero) : zero) : bearable;
            free_x = x0 * faded;
            free_y = y0 * faded;
        }
        const V to_x = free_x + share * moved_x, to_y = free_y + share * moved_y;
        const V part = cut(to_x, to_y, most);
        V x = part * to_x, y = part * to_y;
        // a cut turns springs too little, by half of what it takes of their part aside
        if (turns) {
            const V less = smaller(part, half) * (one - part);
            const V square = larger(to_x * to_x + to_y * to_y, tiny);
            const V ahead = part + less * (free_x * to_x + free_y * to_y) / square;
            x = ahead * to_x - less * free_x;
            y = ahead * to_y - less * free_y;
        }
        V bears_x = x, bears_y = y;
        if constexpr ((P & viscous) != 0) {  // with what dashpots bear
            x = settled(x0 + (x - free_x));
            y = settled(y0 + (y - free_y));
            bears_x = x + drag_x;
            bears_y = y + drag_y;
            const V bears = cut(bears_x, bears_y, bearable);
            bears_x *= bears;
            bears_y *= bears;
        }
        if constexpr ((P & ledger) != 0)
            book(c, k, x, y, bears_x, bears_y, share * moved_x, share * moved_y);
        L::store(c.x + k, x);
        L::store(c.y + k, y);
        const V part_of_sum = weight(k);
        along += part_of_sum * bears_x;
        across += part_of_sum * bears_y;
    }

    /// Enter what springs lose by which the bodies slid so far.
    void book(const Contact<N, Real, P>& c, int k, V x, V y, V bears_x, V bears_y, V slid_x,
              V slid_y) {
        const V x0 = L::load(c.x + k), y0 = L::load(c.y + k);
        const V weight = L::load(places.aside + k) + half * L::load(places.single + N + k);
        V bore_x = x0, bore_y = y0;
        if constexpr ((P & viscous) != 0) {
            const V s = L::load(places.square + k);
            const V bearable = s < L::of(c.edge) ? larger(L::of(c.limit) - s, zero) : zero;
            bore_x = x0 + L::of(c.drag_x);
            bore_y = y0 + L::of(c.drag_y);
            const V bore = cut(bore_x, bore_y, bearable);
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

/// Bring all springs of the contact in a lane to the end of the step.
template <int N, class Real, unsigned P, class T, class Wanted>
inline void march(Contact<N, Real, P>& c, const Numbers<N, Real>& numbers, const Shared<T>& now,
                  int lane, int last, bool viscous_shear, Sums<Wanted>& sums) {
    using All = March<N, Real, P>;
    All all(numbers, now, lane, last, viscous_shear);
    // springs beyond are at rest, once those that were let go have recovered
    const Real reach = larger(c.edge, static_cast<Real>(in_lane(now.edge, lane)));
    const auto moves = [&](int k) {
        if constexpr ((P & viscous) != 0)
            if (c.pressed[k] > 0 || All::places.square[k] < in_lane(now.depth, lane)) return true;
        return All::places.square[k] <= reach;
    };
    for (int k = 0; k < N && (k == 0 || moves(k)); k += All::L::count) all.take(c, k);
    set_lane(sums.x, lane, All::L::total(all.along));
    set_lane(sums.y, lane, All::L::total(all.across));
    if constexpr ((P & ledger) != 0) {
        set_lane(sums.friction, lane, All::L::total(all.rubbed));
        set_lane(sums.viscosity, lane, All::L::total(all.dragged));
    }
}

}  // namespace springs
}  // namespace carom

#include "own_names.h"

#endif
