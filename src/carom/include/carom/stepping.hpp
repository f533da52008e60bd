// carom/stepping.hpp: all springs of a contact brought from one step to the next.
//
// SPDX-License-Identifier: BSD-3-Clause
#ifndef CAROM_STEPPING_HPP
#define CAROM_STEPPING_HPP

#include <algorithm>
#include <cmath>

#include "memory.hpp"

namespace carom {
namespace springs {

/// What all springs of a step share, in spacing^2/R* (and mu/kappa along the contact).
struct Now {
    double unit;            ///< spacing^2/R*
    double depth, before;   ///< d at the end of the step and at its beginning
    double limit;           ///< D = d + tau d'
    double keep;            ///< part of a deflection that is left of a free spring: exp(-dt/tau)
    double moved_x, moved_y;  ///< how far the bodies slid
    double drag_x, drag_y;  ///< tau q'
    double approach;        ///< d' at the end of the step, of viscous bodies
};

/// Velocities at the end of the step follow from those of its middle and of the one before.
template <int N, class Real, unsigned P>
Now now_of(Contact<N, Real, P>& c, const Pair& pair, const Motion& m) {
    Now now{};
    now.unit = double(c.spacing) * c.spacing / pair.radius;
    const double slope = pair.stiffness_ratio / pair.friction / now.unit;
    now.depth = m.penetration / now.unit;
    now.before = now.depth - m.approach * m.step / now.unit;
    now.limit = now.depth;
    if (pair.friction > 0.0) {
        now.moved_x = slope * m.slide_x * m.step;
        now.moved_y = slope * m.slide_y * m.step;
    }
    if constexpr ((P & viscous) != 0) {
        if (pair.retardation > 0.0) {
            double approach = 1.5 * m.approach - 0.5 * c.approach, mean = 1.0;
            const double half = 0.5 * approach * m.step / now.unit;
            if (half > 0.0) {  // mean of d' b and q' b: b goes like the root of the time at first
                const double to = now.depth + half;
                const double from = now.before > 0.0 ? std::max(now.depth - half, 0.0) : 0.0;
                const double rise = to * std::sqrt(to) - from * std::sqrt(from);
                mean = rise * now.unit / (1.5 * m.step * std::sqrt(now.depth)) / approach;
                approach *= mean;
            }
            now.approach = approach;
            now.limit += pair.retardation * approach / now.unit;
            now.keep = std::exp(-m.step / pair.retardation);
            if (pair.friction > 0.0 && pair.viscous_shear) {
                const double drag = slope * pair.retardation * mean;
                now.drag_x = drag * (1.5 * m.slide_x - 0.5 * c.slide_x);
                now.drag_y = drag * (1.5 * m.slide_y - 0.5 * c.slide_y);
            }
        }
        c.approach = static_cast<Real>(m.approach);
        c.slide_x = static_cast<Real>(m.slide_x);
        c.slide_y = static_cast<Real>(m.slide_y);
    }
    return now;
}

/// Return s at the edge: it grows to where surfaces meet, and never beyond where they press.
template <int N, class Real, unsigned P>
double edge_of(const Contact<N, Real, P>& c, const Now& now) {
    if constexpr ((P & viscous) == 0) {
        return now.depth;
    } else {
        double edge = c.edge;
        if (now.limit < edge) return std::max(now.limit, 0.0);
        double here = now.depth - edge - std::max(now.before - edge, 0.0) * now.keep;
        for (int k = static_cast<int>(std::sqrt(edge)); here > 0.0; ++k) {
            const double s = double(k + 1) * (k + 1);
            const double pressed = k + 1 < N ? c.pressed[k + 1] * now.keep : 0.0;
            const double there = now.depth - s - pressed;
            if (there < 0.0) {
                edge += (s - edge) * here / (here - there);
                break;
            }
            edge = s;
            here = there;
        }
        return std::min(edge, now.limit);
    }
}

/// What a step makes of all springs: their force as an integral over x/h, and what they lose.
struct Sums {
    double x, y, friction, viscosity;
};

/// Bring all springs to the end of the step.
template <int N, class Real, unsigned P>
Sums march(Contact<N, Real, P>& c, const Now& now, double edge, bool viscous_shear) {
    static constexpr Weights<N, Real> weights;
    constexpr Real steep = Real(1e20);
    const Real depth = Real(now.depth), before = Real(now.before), limit = Real(now.limit);
    const Real rises = depth - before, touch = rises > 0 ? 1 / rises : Real(0);
    const Real least = rises > 0 ? Real(0) : Real(1), both = viscous_shear ? Real(1) : Real(0);
    const Real keep = Real(now.keep), kept = viscous_shear ? keep : Real(0);
    const Real plain = kept > 0 ? Real(0) : Real(1);  // with losses q + tau q' is what turns
    const Real moved_x = Real(now.moved_x), moved_y = Real(now.moved_y);
    const Real drag_x = Real(now.drag_x), drag_y = Real(now.drag_y), rim = Real(edge);
    Real along[N], across[N], rubbed[N], dragged[N];
    for (int k = 0; k < N; ++k) {
        const Real s = Real(k * k), x0 = c.x[k], y0 = c.y[k];
        const Real inside = (rim - s) * steep;  // beyond the edge springs are free
        // what is touched within the step goes only the rest of its way
        const Real share = smaller(larger((depth - s) * touch, least), Real(1));
        const Real bearable = larger(smaller(limit - s, inside), Real(0));
        Real most = bearable;
        if constexpr ((P & viscous) != 0) {
            const Real free = c.pressed[k] * keep, was = larger(before - s, c.pressed[k]);
            const Real is = larger(larger(depth - s, free), Real(0));
            c.pressed[k] = is;
            const Real grown = larger(smaller(is - larger(was, Real(0)) * keep, inside), Real(0));
            most = both * grown + (1 - both) * bearable;
        }
        const Real free_x = x0 * (1 - kept), free_y = y0 * (1 - kept);
        const Real to_x = free_x + share * moved_x, to_y = free_y + share * moved_y;
        const Real inverse = over_length(to_x, to_y), part = smaller(most * inverse, Real(1));
        // a cut turns springs too little, by half of what it takes of their part aside
        const Real less = plain * smaller(part, Real(0.5)) * (1 - part);
        const Real ahead = part + less * (free_x * to_x + free_y * to_y) * inverse * inverse;
        const Real x = ahead * to_x - less * free_x + x0 * kept;
        const Real y = ahead * to_y - less * free_y + y0 * kept;
        c.x[k] = x;
        c.y[k] = y;
        Real bears_x = x, bears_y = y;
        if constexpr ((P & viscous) != 0) {  // with what dashpots bear
            const Real bears = cut(x + drag_x, y + drag_y, bearable);
            bears_x = (x + drag_x) * bears;
            bears_y = (y + drag_y) * bears;
        }
        if constexpr ((P & ledger) != 0) {
            Real bore_x = x0, bore_y = y0;
            if constexpr ((P & viscous) != 0) {
                const Real rest = (c.edge - s) * steep;
                const Real bore = larger(smaller(c.limit - s, rest), Real(0));
                const Real held = cut(x0 + c.drag_x, y0 + c.drag_y, bore);
                bore_x = (x0 + c.drag_x) * held;
                bore_y = (y0 + c.drag_y) * held;
            }
            const Real mean_x = (bears_x + bore_x) / 2, mean_y = (bears_y + bore_y) / 2;
            const Real went_x = x - x0, went_y = y - y0;
            rubbed[k] = mean_x * (share * moved_x - went_x) + mean_y * (share * moved_y - went_y);
            dragged[k] = (mean_x - (x + x0) / 2) * went_x + (mean_y - (y + y0) / 2) * went_y;
            rubbed[k] *= weights.at[k];
            dragged[k] *= weights.at[k];
        }
        along[k] = weights.at[k] * bears_x;
        across[k] = weights.at[k] * bears_y;
    }
    Sums sums{};
    sums.x = total(along);
    sums.y = total(across);
    if constexpr ((P & ledger) != 0) {
        sums.friction = total(rubbed);
        sums.viscosity = total(dragged);
    }
    return sums;
}

/// Correct the force for the last cell, which ends at the edge.
template <int N, class Real, unsigned P>
void trim(const Contact<N, Real, P>& c, const Now& now, double edge, Sums& sums) {
    const double beta = std::sqrt(edge);
    const int last = std::min(static_cast<int>(beta), N - 1);
    const double s = double(last) * last, inner = inner_share(last, beta);
    if (!(edge > s)) return;
    const double x = c.x[last] + now.drag_x, y = c.y[last] + now.drag_y;
    const double part = (P & viscous) ? cut(x, y, std::max(now.limit - s, 0.0)) : 1.0;
    const double less = inner - (3.0 * last + 2.0) / (6.0 * last + 3.0);
    const double outer = (beta - last - inner) *
                         cut(now.drag_x, now.drag_y, std::max(now.limit - edge, 0.0));
    sums.x += less * part * x + outer * now.drag_x;
    sums.y += less * part * y + outer * now.drag_y;
}

}  // namespace springs
}  // namespace carom

#endif
