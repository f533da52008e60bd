// What is said once a run of contacts that are too short or too deep, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "watch.h"

#include <cmath>

#include "carom/impacts.hpp"
#include "error.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

constexpr double fewest_steps = 20.0;  // an elastic impact loses or gains up to 0.1 % of its energy

/// Return how long bodies will touch, without losses; those that are pressed have energy of Hertz.
double duration_of(const carom::Pair &pair, const carom::Encounter &now) {
    const double approach = carom::dot(now.velocity, now.normal);
    const double pressed = 2.0 * carom_pressed(pair, now.penetration) / pair.mass;
    return carom::duration_of(pair, std::sqrt(approach * approach + pressed));
}

}  // namespace

void CaromWatch::begin() {
    constexpr int minimizing = 2;
    minimize = update->whichflag == minimizing;
    limit = !modify->get_fix_by_style("^nve/limit").empty();
    coarse = deep = false;
}

std::string CaromWatch::who(tagint one, tagint other) const {
    if (other == wall) return fmt::format("{}: atom {} and the wall", style, one);
    return fmt::format("{}: atoms {} and {}", style, one, other);
}

void CaromWatch::meet(const carom::Pair &pair, const carom::Encounter &now, tagint one,
                      tagint other) {
    if (limit || minimize || coarse) return;
    const double duration = duration_of(pair, now);
    if (!(duration < fewest_steps * now.step)) return;
    coarse = true;
    error->warning(FLERR, "{}: their contact lasts {:.1f} time steps, but at least {:.0f} keep the "
                          "energy; give timestep {:.3g} or less (said once a run)", who(one, other),
                   duration / now.step, fewest_steps, duration / fewest_steps);
}

void CaromWatch::soften(carom::Pair &pair, double depth, tagint one, tagint other) {
    if (!limit || depth < pair.radius) return;
    if (!deep)
        error->warning(FLERR, "{}: overlap {:.4g} is not below R* = {:.4g}; under nve/limit the force "
                              "on them is not exact (said once a run)", who(one, other), depth,
                       pair.radius);
    deep = true;
    pair.radius = 1.001 * depth;
}

void CaromWatch::check(carom::Status status, const carom::Pair &pair, double depth, tagint one,
                       tagint other) const {
    if (status == carom::Status::ok) return;
    if (depth >= pair.radius)
        error->one(FLERR, "{}: overlap {:.4g} must be below R* = {:.4g}; part the spheres at first by "
                          "minimize or fix nve/limit, or give a shorter timestep", who(one, other),
                   depth, pair.radius);
    error->one(FLERR, "{}: {}", who(one, other), carom::message(status));
}
