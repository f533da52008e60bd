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
struct Now {
    double unit;            ///< spacing^2/R*
    double rises, depth, before;  ///< d at the end of the step and at its beginning, the difference
    double excess, limit;   ///< tau d', D = d + tau d'
    double fade;            ///< part of a deflection that a free spring loses: 1 - exp(-dt/tau)
    double least, most;     ///< what of its share in the step a spring has: depth - s, if it rises
    double moved_x, moved_y;  ///< how far the bodies slid, for each share
    double drag_x, drag_y;  ///< tau q'
    double approach;        ///< d' at the end of the step, of viscous bodies
};

/// The part of a deflection that a free spring loses in a step, which contacts in a row mostly share.
class Fading {
    double steps = 0.0, part = 0.0;

  public:
    /// Return 1 - exp(-steps), of a step in retardation times.
    double after(double now) {
        if (now != steps) part = -std::expm1(-(steps = now));
        return part;
    }
};

/// Return the mean of b around the end of a step over b there, the bodies approaching by `half`
/// in half a step: dashpots bear so much more while b goes like the root of the time. The first
/// step counts from the touch. No difference of powers is taken: they may be equal to rounding.
inline double mean_at_end(double depth, double before, double half) {
    if (!(half > 0.0)) return 1.0;
    const double back = std::min(before > 0.0 ? half : 2.0 * half, depth);
    const double to = std::sqrt(depth + half), from = std::sqrt(depth - back);
    const double there = std::sqrt(std::max(depth, 1e-40 * half));
    return (back + half) * (to * (to + from) + from * from) / (3.0 * half * (to + from) * there);
}

/// Velocities at the end of the step follow from those of its middle and of the one before.
template <int N, class Real, unsigned P>
inline void look(Contact<N, Real, P>& c, const Pair& pair, const Motion& m, Fading& fading,
                 Now& now) {
    now.fade = 1.0;
    now.moved_x = now.moved_y = now.drag_x = now.drag_y = 0.0;
    now.unit = double(c.spacing) * c.spacing / pair.radius;
    const double per_unit = pair.radius / (double(c.spacing) * c.spacing);
    now.rises = m.approach * m.step * per_unit;
    now.depth = m.penetration * per_unit;
    now.limit = now.depth;
    const bool is_rising = now.rises > 1e-12 * (now.depth + 1.0);
    now.least = is_rising ? 0.0 : 1.0;
    now.most = is_rising ? now.rises : 1.0;
    const double friction = std::max(pair.friction, 1.0 / largest);
    const double slope = per_unit * pair.stiffness_ratio / (friction * now.most);
    if (pair.friction > 0.0) {
        now.moved_x = slope * m.slide_x * m.step;
        now.moved_y = slope * m.slide_y * m.step;
    }
    if constexpr ((P & viscous) != 0) {
        now.before = now.depth - now.rises;
        now.excess = now.approach = 0.0;
        if (pair.retardation > 0.0) {
            const double approach = (1.5 * m.approach - 0.5 * c.approach) * per_unit;
            const double mean = mean_at_end(now.depth, now.before, 0.5 * approach * m.step);
            now.approach = mean * approach;
            now.excess = std::min(pair.retardation * now.approach, farthest<Real>);
            now.limit = std::max(now.limit + now.excess, 0.0);
            now.fade = fading.after(m.step / pair.retardation);
            if (pair.friction > 0.0 && pair.viscous_shear) {
                const double drag = slope * now.most * pair.retardation * mean;
                now.drag_x = drag * (1.5 * m.slide_x - 0.5 * c.slide_x);
                now.drag_y = drag * (1.5 * m.slide_y - 0.5 * c.slide_y);
            }
        }
        shorten<Real>(now.drag_x, now.drag_y, 1.0);
        c.approach = static_cast<Real>(m.approach);
        c.slide_x = static_cast<Real>(m.slide_x);
        c.slide_y = static_cast<Real>(m.slide_y);
    }
    shorten<Real>(now.moved_x, now.moved_y, now.most);
}

/// Return s at the edge, rounded as it is kept: it grows to where surfaces meet, and not beyond
/// where they press.
template <int N, class Real, unsigned P>
inline double edge_of(const Contact<N, Real, P>& c, const Now& now) {
    if constexpr ((P & viscous) == 0) {
        return now.depth;
    } else {
        double edge = c.edge;
        if (now.limit < edge) return static_cast<Real>(now.limit);
        const double keep = 1.0 - now.fade, was = now.before - edge;
        double here = was > 0.0 ? now.rises + was * now.fade : now.depth - edge;
        for (int k = static_cast<int>(std::sqrt(edge)); here > 0.0; ++k) {
            const double s = double(k + 1) * (k + 1);
            const double pressed = k + 1 < N ? c.pressed[k + 1] * keep : 0.0;
            const double there = now.depth - s - pressed;
            if (there < 0.0) {
                edge += (s - edge) * here / (here - there);
                break;
            }
            edge = s;
            here = there;
        }
        return static_cast<Real>(std::min(edge, now.limit));
    }
}

}  // namespace springs
}  // namespace carom

#include "own_names.h"

#endif
