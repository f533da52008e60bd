// carom/stepping.hpp: what all springs of a contact share in a step.
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
    double least, most;     ///< what of its share in the step a spring has: depth - s, if it rises
    double moved_x, moved_y;  ///< how far the bodies slid, for each share
    double drag_x, drag_y;  ///< tau q'
    double approach;        ///< d' at the end of the step, of viscous bodies
};

/// Velocities at the end of the step follow from those of its middle and of the one before.
template <int N, class Real, unsigned P>
inline void look(Contact<N, Real, P>& c, const Pair& pair, const Motion& m, Now& now) {
    now.keep = now.approach = now.moved_x = now.moved_y = now.drag_x = now.drag_y = 0.0;
    now.unit = double(c.spacing) * c.spacing / pair.radius;
    const double per_unit = pair.radius / (double(c.spacing) * c.spacing);
    const double rises = m.approach * m.step * per_unit;
    now.depth = m.penetration * per_unit;
    now.before = now.depth - rises;
    now.limit = now.depth;
    const bool is_rising = rises > 1e-12 * now.depth;
    now.least = is_rising ? 0.0 : 1.0;
    now.most = is_rising ? rises : 1.0;
    const double slope = per_unit * pair.stiffness_ratio / (pair.friction * now.most);
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
                const double drag = slope * now.most * pair.retardation * mean;
                now.drag_x = drag * (1.5 * m.slide_x - 0.5 * c.slide_x);
                now.drag_y = drag * (1.5 * m.slide_y - 0.5 * c.slide_y);
            }
        }
        c.approach = static_cast<Real>(m.approach);
        c.slide_x = static_cast<Real>(m.slide_x);
        c.slide_y = static_cast<Real>(m.slide_y);
    }
}

/// Return s at the edge: it grows to where surfaces meet, and never beyond where they press.
template <int N, class Real, unsigned P>
inline double edge_of(const Contact<N, Real, P>& c, const Now& now) {
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

}  // namespace springs
}  // namespace carom

#endif
