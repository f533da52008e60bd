// fix wall/carom: the exact contact of spheres with the surface of a region, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "fix_wall_carom.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "error.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "region.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

/// Whether a contact had begun when its last step ended.
bool has_touched(const double *memory) { return memory[DEPTH] > 0.0; }
}  // namespace

void FixWallCarom::setup(int vflag) { post_force(vflag); }

void FixWallCarom::post_force(int) {
    std::fill(sums, sums + FRICTION, 0.0);
    region->prematch();
    if (moves()) follow();
    if (update->setupflag || neighbor->ago == 0) find_near();
    if (shows) std::fill_n(*array_atom, atom->nlocal * COLUMNS, 0.0);
    if (shows) size_local_rows = 0;
    Meetings met;
    for (int i : near) find_met(i, met);
    step(met);
}

/// Whether the wall moves, by itself or as its region changes.
bool FixWallCarom::moves() const { return region->dynamic || region->varshape; }

/// Let LAMMPS find the velocity of the wall from where it was a step before. Where nobody has looked
/// then, or the wall was displaced between runs, it would take this way for that of a step; a wall
/// starts from rest instead.
void FixWallCarom::follow() {
    const bigint now = update->ntimestep;
    if (update->setupflag || now != followed + 1) update->ntimestep = 0;
    region->set_velocity();
    update->ntimestep = followed = now;
}

/// Whether no sphere comes nearer to a wall than by the skin before LAMMPS lists neighbors again.
/// Where surfaces are cut off they may begin anywhere.
bool FixWallCarom::waits() const {
    for (const Fix *fix : modify->get_fix_list())
        if (fix->diam_flag) return false;
    return !moves() && region->nregion == 1 && !region->openflag && neighbor->dist_check &&
           neighbor->every == 1 && neighbor->delay == 0 && !neighbor->build_once;
}

/// List the spheres that may meet a wall, or part from one, until LAMMPS lists neighbors again.
void FixWallCarom::find_near() {
    const bool all = !waits();
    near.clear();
    for (int i = 0; i < atom->nlocal; ++i) {
        const double *x = atom->x[i];
        if (all || memories.first(i) != memories.end(i) || !region->match(x[0], x[1], x[2]) ||
            region->surface(x[0], x[1], x[2], reach_of(i) + neighbor->skin) > 0)
            near.push_back(i);
    }
}

/// Collect the walls that a sphere touches, and step them when there are enough.
void FixWallCarom::find_met(int i, Meetings &met) {
    const int count = atom->mask[i] & groupbit ? find_walls(i) : 0;
    if (changes(i, count)) change(i, count);
    double *memory = memories.first(i);
    for (int k = 0; memory != memories.end(i); ++k)
        if (region->contact[k].iwall == memory[WALL]) {
            meet(i, k, memory, met);
            memory += memories.length();
        }
}

/// Have the region find the walls that a sphere may touch, and return how many.
int FixWallCarom::find_walls(int i) const {
    const double *x = atom->x[i];
    const int count = region->surface(x[0], x[1], x[2], reach_of(i));
    const bool inside = count > 0 && region->nregion == 1;  // a single region has but one side
    if (!inside && !region->match(x[0], x[1], x[2]))
        error->one(FLERR, "fix wall/carom: atom {} is outside region {}", atom->tag[i], name);
    return count;
}

/// Whether a sphere and a wall that the region has found touch: a neck is only drawn out by those
/// that have touched.
bool FixWallCarom::touches(int i, int k, const double *memory) const {
    return region->contact[k].r < atom->radius[i] || (memory && has_touched(memory));
}

/// Whether a sphere touches other walls than those that it remembers, in the region's order.
bool FixWallCarom::changes(int i, int count) const {
    const double *memory = memories.first(i), *end = memories.end(i);
    for (int k = 0; k < count; ++k) {
        const bool is_next = memory != end && memory[WALL] == region->contact[k].iwall;
        if (!touches(i, k, is_next ? memory : nullptr)) continue;
        if (!is_next) return true;
        memory += memories.length();
    }
    return memory != end;
}

/// Keep the memories of walls that a sphere touches, new ones too. What is still stored in the others
/// is lost at last.
void FixWallCarom::change(int i, int count) {
    std::vector<double> list;
    std::vector<int> handed_on;
    for (int k = 0; k < count; ++k) {
        const int wall = region->contact[k].iwall;
        const double *memory = memories.of(i, wall);
        if (!touches(i, k, memory)) continue;
        if (!memory && (memory = left_for(i, k, count)))
            handed_on.push_back(static_cast<int>(memory[WALL]));
        memories.add(list, wall, memory);
    }
    memories.swap(i, list);
    for (std::size_t at = 0; at < list.size(); at += memories.length()) {
        const int wall = static_cast<int>(list[at + WALL]);
        const bool is_kept = std::find(handed_on.begin(), handed_on.end(), wall) != handed_on.end();
        if (is_kept || memories.of(i, wall)) continue;
        if (atom->mask[i] & groupbit) see_end(&list[at], i);
        const double last = kind.stored(&list[at] + SPRINGS);
        sums[options.viscous ? VISCOSITY : FRICTION] += last;
        of_spheres.add(i, options.viscous ? 0.0 : last, options.viscous ? last : 0.0);
    }
}

/// Return the memory of a wall that the sphere leaves for this one in the same plane, as at a seam of
/// two walls; nullptr if there is none.
const double *FixWallCarom::left_for(int i, int k, int count) const {
    const Region::Contact &wall = region->contact[k];
    const double depth = atom->radius[i] - wall.r;
    const double speed = std::sqrt(carom::dot(carom_vector(atom->v[i]), carom_vector(atom->v[i])));
    const carom::Vector apart = {wall.delx, wall.dely, wall.delz};
    for (const double *memory = memories.first(i); memory != memories.end(i);
         memory += memories.length()) {
        bool stays = false;
        for (int n = 0; n < count; ++n) stays = stays || region->contact[n].iwall == memory[WALL];
        const carom::Vector force = carom_vector(memory + FORCE);
        const double along = carom::dot(force, apart) / wall.r;
        const bool is_in_plane = 2.0 * along * along > carom::dot(force, force) && along > 0.0;
        const double moved = speed * update->dt + 1e-9 * atom->radius[i];
        if (!stays && is_in_plane && std::fabs(memory[DEPTH] - depth) <= moved) return memory;
    }
    return nullptr;
}

/// See whether a sphere came to the wall, or the wall to it.
void FixWallCarom::see_begin(const carom::Encounter &now, int i) {
    if (update->setupflag) return;
    const double speed = std::sqrt(carom::dot(now.velocity, now.velocity));
    watch.jump(now.penetration, -carom::dot(now.velocity, now.normal), speed, now.step, atom->radius[i],
               atom->tag[i]);
}

/// See whether a sphere left the wall, or the wall it; of a wall that moves it is not known.
void FixWallCarom::see_end(const double *memory, int i) {
    const carom::Vector force = carom_vector(memory + FORCE), velocity = carom_vector(atom->v[i]);
    const double size = std::sqrt(carom::dot(force, force));
    if (update->setupflag || moves() || !(size > 0.0)) return;
    watch.jump(memory[DEPTH], carom::dot(velocity, force) / size,
               std::sqrt(carom::dot(velocity, velocity)), update->dt, atom->radius[i], atom->tag[i]);
}

/// Return how far from its centre a sphere meets a wall.
double FixWallCarom::reach_of(int i) const {
    const double radius = atom->radius[i];
    const CaromCohesion &cohesion = bodies[atom->type[i]].cohesion;
    if (!cohesion) return radius;
    return radius + 4.0 * carom_neck(cohesion, radius);  // as R* is larger at a hollow wall
}

/// Add a contact to those that are stepped together.
void FixWallCarom::meet(int i, int k, double *memory, Meetings &met) {
    const Region::Contact &wall = region->contact[k];
    const CaromBodies &known = bodies[atom->type[i]];
    if (!(known.pair.modulus > 0.0))
        error->one(FLERR, "fix wall/carom: spheres of type {} have no young, poisson or friction; "
                          "give them by pair_coeff {} {} carom", atom->type[i], atom->type[i],
                   atom->type[i]);
    const int n = met.batch.count++;
    const double radius = atom->radius[i], curved = wall.radius;  // negative if hollow
    carom_fetch(memory, memories.length());
    met.spheres[n] = i;
    met.batch.memories[n] = memory;
    carom::Pair &pair = met.batch.pairs[n] = known.pair;
    pair.radius = curved == 0.0 ? radius : radius * curved / (radius + curved);
    pair.mass = styles.front()->mass_of(i);
    if (known.loss > 0.0) pair.retardation = memory[RETARDATION];
    if (!has_touched(memory) || known.cohesion || watch.limits()) met.is_plain = false;
    met.radius[n] = radius;
    met.share[n] = known.share;
    const carom::Vector apart = {wall.delx, wall.dely, wall.delz}, spin = carom_vector(atom->omega[i]);
    carom::Vector velocity = carom_vector(atom->v[i]);
    if (moves()) {
        double of_wall[3] = {0.0, 0.0, 0.0};
        carom::Vector place = carom_vector(atom->x[i]);
        region->velocity_contact(of_wall, place.data(), k);
        velocity = carom::plus(velocity, -1.0, carom_vector(of_wall));
    }
    for (int j = 0; j < 3; ++j) {
        met.apart[j][n] = apart[j];
        met.velocity[j][n] = velocity[j];
        met.spin[j][n] = spin[j];
    }
    if (n + 1 == CaromBatch::most) step(met);
}

/// Bring contacts to the end of the step, and add what they do.
void FixWallCarom::step(Meetings &met) {
    CaromBatch &batch = met.batch;
    look(met);
    for (int n = 0; n < batch.count && !met.is_plain; ++n) prepare(met, n);
    for (int n = 0; n < batch.count; ++n) {
        const double depth =
            carom::in_lane(batch.meetings[n / carom::lanes].penetration, n % carom::lanes);
        watch.press(batch.pairs[n], depth, update->dt, atom->tag[met.spheres[n]], CaromWatch::wall);
    }
    carom_step(kind, batch, update->setupflag);
    for (int n = 0; n < batch.count; ++n) apply(met, n);
    batch.count = 0;
    met.is_plain = true;
}

/// Find what contacts see of spheres and walls, in lanes; those left over have a contact before.
void FixWallCarom::look(Meetings &met) const {
    using carom::Wide;
    const auto all = [](const double (&of)[3][CaromBatch::most], int n) {
        return carom::Triple<Wide::Type>{Wide::load(of[0] + n), Wide::load(of[1] + n),
                                         Wide::load(of[2] + n)};
    };
    carom::Bodies wall{}, sphere{};  // seen from the wall, to lose no digits
    if (region->rotateflag)
        for (int j = 0; j < 3; ++j) wall.spin[j] = Wide::of(region->omega[j]);
    for (int n = 0; n < met.batch.count; n += carom::lanes) {
        sphere = {all(met.apart, n), all(met.velocity, n), all(met.spin, n), Wide::load(met.radius + n)};
        met.batch.meetings[n / carom::lanes] =
            carom::encounter(sphere, wall, update->dt, Wide::load(met.share + n));
    }
}

/// Tell a contact what matters at the first touch, and what changes what it sees.
void FixWallCarom::prepare(Meetings &met, int n) {
    const int i = met.spheres[n];
    const CaromBodies &known = bodies[atom->type[i]];
    double *memory = met.batch.memories[n];
    carom::Pair &pair = met.batch.pairs[n];
    carom::Encounters *meetings = met.batch.meetings;
    if (!has_touched(memory)) {
        see_begin(carom::one_of(meetings, n), i);
        if (known.loss > 0.0)
            pair.retardation = memory[RETARDATION] = carom_retardation(known, pair);
    }
    if (!known.cohesion && !watch.limits()) return;
    carom::Encounter now = carom::one_of(meetings, n);
    if (known.cohesion) carom_cohere(known.cohesion, pair.radius, now);
    watch.soften(pair, now.penetration, atom->tag[i], CaromWatch::wall);
    carom::set_one(meetings, n, now);
}

/// Add what a contact does.
void FixWallCarom::apply(const Meetings &met, int n) {
    const CaromBatch &batch = met.batch;
    const int i = met.spheres[n], lane = n % carom::lanes;
    const carom::Encounters &now = batch.meetings[n / carom::lanes];
    const carom::Actions &actions = batch.actions[n / carom::lanes];
    double *memory = batch.memories[n];
    const double depth = carom::in_lane(now.penetration, lane);
    if (batch.statuses[n] != carom::Status::ok)
        watch.check(batch.statuses[n], batch.pairs[n], depth, atom->tag[i], CaromWatch::wall);
    carom::Vector force = carom::in_lane(actions.force, lane);
    if (options.tangential) force = carom_aside(force, carom::in_lane(now.normal, lane));
    carom_keep(memory, force, depth);
    carom_add(atom->f[i], 1.0, force);
    carom_add(atom->torque[i], 1.0, carom::in_lane(actions.torque, lane));
    carom_add(sums + FORCE_X, -1.0, force);
    double stored = kind.stored(memory + SPRINGS);
    if (!options.viscous && !options.tangential) stored += carom_pressed(batch.pairs[n], depth);
    const double rubbed = carom::in_lane(actions.friction, lane);
    const double damped = carom::in_lane(actions.viscosity, lane);
    sums[ELASTIC] += stored;
    sums[FRICTION] += rubbed;
    sums[VISCOSITY] += damped;
    if (options.ledger) {
        memory[SPRINGS + kind.lost] += rubbed;
        memory[SPRINGS + kind.lost + 1] += damped;
        of_spheres.add(i, rubbed, damped);
    }
    if (shows) show(met, n, stored);
}

/// Enter a contact into what is shown of it, and of its sphere.
void FixWallCarom::show(const Meetings &met, int n, double stored) {
    if (size_local_rows == local_room)
        memory->grow(array_local, local_room = 2 * local_room + 64, LOCAL_COLUMNS, "wall/carom:local");
    const int i = met.spheres[n];
    const double *kept = met.batch.memories[n];
    double *all = array_atom[i], *row = array_local[size_local_rows++];
    row[0] = static_cast<double>(atom->tag[i]);
    row[1] = kept[WALL] + 1.0;
    const double share = 1.0 / (all[WALLS] += 1.0);
    for (int j = 0; j < 3; ++j) {
        const double point = atom->x[i][j] - met.apart[j][n];
        row[2 + j] = kept[FORCE + j];
        row[5 + j] = point;
        all[FORCE_ON + j] += kept[FORCE + j];
        all[POINT + j] += share * (point - all[POINT + j]);  // the mean
    }
    all[RADIUS] = atom->radius[i];
    row[OVERLAP] = kept[DEPTH];
    row[STORED] = stored;
    std::fill_n(row + LOST, 2, 0.0);
    if (options.ledger) std::copy_n(kept + SPRINGS + kind.lost, 2, row + LOST);
}
