// carom/contact.hpp: the exact contact of spheres, step by step, for programs that move particles.
//
// SPDX-License-Identifier: BSD-3-Clause
//
// C++17, nothing to link, no allocation. Of every contact keep a Contact, all zeros before the first
// touch, and call `advance` in each step with the motion of the contact point:
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

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "springs.hpp"

namespace carom {

/// Two bodies as their contact knows them.
struct Pair {
    double modulus;          ///< E*: 1/E* = (1 - nu^2)/E of one body + that of the other
    double radius;           ///< R*: 1/R* = 1/R_1 + 1/R_2
    double stiffness_ratio;  ///< kappa = G*/E*: 1/G* = (2 - nu)(1 + nu)/(2 E), summed, too
    double friction;         ///< mu, 0 for none
    double mass;             ///< m_1 m_2/(m_1 + m_2): how deep an impact goes, from which springs
                             ///< get their places; forces do not depend on it
    double retardation = 0;  ///< time, of a Contact that is viscous
    bool viscous_shear = true;  ///< whether shear loses energy, too; if not, friction is exceeded
};

/// Motion of the contact in a step: penetration at its end, velocities in its middle (those of
/// velocity Verlet while forces are computed), the step.
struct Motion {
    double penetration;
    double approach;  ///< normal velocity, positive while the bodies approach
    double slide_x, slide_y;  ///< tangential velocity of the contact point
    double step;
};

/// Forces at the end of a step, x and y against the slide, and the energy that was lost in it.
struct Load {
    double normal, x, y;
    double friction, viscosity;  ///< of a Contact that keeps a ledger
};

enum class Status { ok, bad_pair, bad_motion };

/// One line for a status.
inline const char* message(Status status) {
    if (status == Status::bad_pair)
        return "modulus, radius, stiffness_ratio and mass must be positive and finite, friction and "
               "retardation zero or positive";
    if (status == Status::bad_motion)
        return "the motion must be finite, the step positive, the penetration below the radius";
    return "ok";
}

namespace springs {
template <int N, class Real, bool> struct Recovery {};
template <int N, class Real> struct Recovery<N, Real, true> {
    Real pressed[N];  ///< how far springs are pressed that were let go
    Real approach, slide_x, slide_y;  ///< velocities of the step before
    Real limit, drag_x, drag_y;  ///< D and tau q' then
};
template <class Real, bool> struct Ledger {};
template <class Real> struct Ledger<Real, true> {
    Real stored;  ///< work done on the contact that is not lost
    Real normal, shear_x, shear_y;  ///< forces of the step before
    Real power;  ///< that dashpots took in compression then
};
}  // namespace springs

/// The memory of a contact: N springs; plain numbers, all zeros while the bodies are apart.
template <int N, class Real = double, unsigned P = elastic>
struct Contact : springs::Recovery<N, Real, (P & viscous) != 0>,
                 springs::Ledger<Real, (P & ledger) != 0> {
    static_assert(N >= 8 && N <= 4096 && N % 4 == 0, "8 to 4096 springs, a multiple of 4");
    Real spacing;  ///< of the springs; 0 while the bodies are apart
    Real edge;     ///< s at the edge of the contact, in spacing^2/R*
    Real x[N], y[N];  ///< deflections of the springs, in spacing^2/R* times mu/kappa
};

namespace springs {

inline bool is_good(const Pair& p) {
    const double most = std::numeric_limits<double>::max();
    return p.modulus > 0.0 && p.modulus <= most && p.radius > 0.0 && p.radius <= most &&
           p.stiffness_ratio > 0.0 && p.stiffness_ratio <= most && p.mass > 0.0 && p.mass <= most &&
           p.friction >= 0.0 && p.friction <= most && p.retardation >= 0.0 && p.retardation <= most;
}

inline bool is_good(const Motion& m, double radius) {
    return std::isfinite(m.approach) && std::isfinite(m.slide_x) && std::isfinite(m.slide_y) &&
           m.step > 0.0 && std::isfinite(m.step) && m.penetration < radius &&
           m.penetration > -std::numeric_limits<double>::infinity();
}

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

template <int N, class Real, unsigned P>
void scale_lattice(Contact<N, Real, P>& c, void (*change)(Real (&)[N]), Real wider) {
    change(c.x);
    change(c.y);
    c.spacing *= wider;
    c.edge /= wider * wider;
    if constexpr ((P & viscous) != 0) {
        change(c.pressed);
        for (Real* each : {&c.limit, &c.drag_x, &c.drag_y}) *each /= wider * wider;
    }
}

/// Give springs their places at the first touch: so that the impact is to fill them.
template <int N, class Real, unsigned P>
void begin(Contact<N, Real, P>& c, const Pair& pair, const Motion& m) {
    constexpr double margin = 1.04;
    c = Contact<N, Real, P>{};
    const double energy = 0.9375 * pair.mass * m.approach * m.approach;
    const double deepest = std::pow(energy / (pair.modulus * std::sqrt(pair.radius)), 0.4);
    const double reach = margin * std::max(deepest, m.penetration);
    c.spacing = static_cast<Real>(std::sqrt(pair.radius * reach) / N);
    if constexpr ((P & viscous) != 0) {
        c.approach = static_cast<Real>(m.approach);
        c.slide_x = static_cast<Real>(m.slide_x);
        c.slide_y = static_cast<Real>(m.slide_y);
    }
}

/// Widen the lattice if the contact has outgrown it, refine it if it has shrunk to a quarter.
template <int N, class Real, unsigned P>
void fit_lattice(Contact<N, Real, P>& c, const Pair& pair, const Motion& m) {
    const auto reach = [&] { return double(c.spacing) * c.spacing / pair.radius * N * N; };
    const bool shrinks = m.approach < 0.0 && m.penetration < reach() / 16.0;
    if (shrinks) scale_lattice(c, refine<N, Real>, Real(0.5));
    while (m.penetration > reach()) scale_lattice(c, coarsen<N, Real>, Real(2));
}

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
            double approach = 1.5 * m.approach - 0.5 * c.approach;
            const double half = 0.5 * approach * m.step / now.unit;
            if (half > 0.0) {  // mean of tau d' b, which goes like the root of the time at first
                const double to = now.depth + half;
                const double from = now.before > 0.0 ? std::max(now.depth - half, 0.0) : 0.0;
                const double rise = to * std::sqrt(to) - from * std::sqrt(from);
                approach = rise * now.unit / (1.5 * m.step * std::sqrt(now.depth));
            }
            now.approach = approach;
            now.limit += pair.retardation * approach / now.unit;
            now.keep = std::exp(-m.step / pair.retardation);
            if (pair.friction > 0.0 && pair.viscous_shear) {
                const double drag = slope * pair.retardation;
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

// By value, unlike those of the standard library: so that loops become vectors.
template <class Real> Real larger(Real a, Real b) { return a > b ? a : b; }
template <class Real> Real smaller(Real a, Real b) { return a < b ? a : b; }

/// Factor that cuts a vector back to a length; without a branch, so that loops become vectors.
template <class Real> Real cut(Real x, Real y, Real most) {
    const Real square = larger(x * x + y * y, std::numeric_limits<Real>::min());
    return smaller(most / std::sqrt(square), Real(1));
}

/// Sum of a line, by halves.
template <int N, class Real> Real total(const Real (&line)[N]) {
    constexpr int lanes = N % 16 == 0 ? 16 : 4;
    Real part[lanes] = {}, sum = 0;
    for (int first = 0; first < N; first += lanes)
        for (int lane = 0; lane < lanes; ++lane) part[lane] += line[first + lane];
    for (Real each : part) sum += each;
    return sum;
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
        const Real to_x = x0 * (1 - kept) + share * moved_x, to_y = y0 * (1 - kept) + share * moved_y;
        const Real part = cut(to_x, to_y, most);
        const Real x = to_x * part + x0 * kept, y = to_y * part + y0 * kept;
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
    const double part = cut(x, y, std::max(now.limit - s, 0.0));
    const double less = inner - (3.0 * last + 2.0) / (6.0 * last + 3.0);
    const double outer = (beta - last - inner) *
                         cut(now.drag_x, now.drag_y, std::max(now.limit - edge, 0.0));
    sums.x += less * part * x + outer * now.drag_x;
    sums.y += less * part * y + outer * now.drag_y;
}

/// Keep what the next step needs of this one.
template <int N, class Real, unsigned P>
void keep(Contact<N, Real, P>& c, const Now& now, double edge, double scale, const Motion& m, Load& load) {
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
        double work = 0.5 * m.step * ((load.x + c.shear_x) * m.slide_x + (load.y + c.shear_y) * m.slide_y);
        if constexpr ((P & viscous) != 0) work += 0.5 * m.step * (load.normal + c.normal) * m.approach;
        c.stored += static_cast<Real>(work - load.friction - load.viscosity);
        c.normal = static_cast<Real>(load.normal);
        c.shear_x = static_cast<Real>(load.x);
        c.shear_y = static_cast<Real>(load.y);
    }
}

/// Let go: what is still stored goes into the dashpots, or was rubbed off at last.
template <int N, class Real, unsigned P> void part(Contact<N, Real, P>& c, const Motion& m, Load& load) {
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
    if (!springs::is_good(pair)) return Status::bad_pair;
    if (!springs::is_good(motion, pair.radius)) return Status::bad_motion;
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
        const double energy = scale * now.unit * pair.friction * pair.friction / pair.stiffness_ratio;
        load.friction = energy * sums.friction;
        load.viscosity = energy * sums.viscosity;
    }
    springs::keep(contact, now, edge, scale, motion, load);
    springs::enter(contact, motion, load);
    return Status::ok;
}

}  // namespace carom

#endif
