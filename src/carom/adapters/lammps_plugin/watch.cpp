// What is said once a run of contacts that are too short or too deep, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "watch.h"

#include <algorithm>
#include <cmath>

#include "carom/impacts.hpp"
#include "error.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

void CaromWatch::begin() {
    constexpr int minimizing = 2;
    minimize = update->whichflag == minimizing;
    limit = !modify->get_fix_by_style("^nve/limit").empty();
    stiff = jumped = deep = false;
}

std::string CaromWatch::who(tagint one, tagint other) const {
    if (other == wall) return fmt::format("{}: atom {} and the wall", style, one);
    return fmt::format("{}: atoms {} and {}", style, one, other);
}

void CaromWatch::tell_stiff(const carom::Pair &pair, double depth, double step, tagint one,
                            tagint other) {
    stiff = true;
    const double longest = carom::longest_step(pair, depth);
    error->warning(FLERR, "{}: pressed by {:.3g} they are too stiff for the timestep, their motion may "
                          "gain energy: k dt^2/m* is {:.3g}, of at most {:.2g}; give timestep {:.3g} or "
                          "less (said once a run)", who(one, other), depth,
                   carom::stiffest_step * step * step / (longest * longest), carom::stiffest_step, 0.99 * longest);
}

void CaromWatch::jump(double depth, double normal_speed, double speed, double step, double radius,
                      tagint atom) {
    const double moved = speed * step;
    const double farthest = 2.0 * std::max(normal_speed, 0.0) * step + moved * moved / radius;
    if (jumped || minimize || depth <= farthest + 1e-9 * radius) return;
    jumped = true;
    error->warning(FLERR, "{}: the wall begins or ends where it is pressed by {:.3g}, further than they move "
                          "in a step, and energy is gained or lost; parts of a union must not overlap, and "
                          "spheres not begin inside a wall (said once a run)", who(atom, wall), depth);
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
                          "minimize or fix nve/limit, or give a shorter timestep; those of a clump do not "
                          "see each other by neigh_modify exclude molecule/intra all", who(one, other),
                   depth, pair.radius);
    error->one(FLERR, "{}: {}", who(one, other), carom::message(status));
}
