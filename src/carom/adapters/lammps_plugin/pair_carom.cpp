// pair_style carom: the exact contact of spheres, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "pair_carom.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {

/// Spheres as LAMMPS keeps them.
struct Spheres {
    double **x, **v, **omega, *radius, *mass;

    Spheres(const Atom &atom, double *masses)
        : x(atom.x), v(atom.v), omega(atom.omega), radius(atom.radius), mass(masses) {}

    carom::Body body(int k) const {
        return {carom_vector(x[k]), carom_vector(v[k]), carom_vector(omega[k]), radius[k]};
    }
    /// Return several, one in each lane.
    carom::Bodies in_lanes(const int *which) const {
        const auto of = [&](double **all, int i) {
            return carom::Wide::each([&](int lane) { return all[which[lane]][i]; });
        };
        return {{of(x, 0), of(x, 1), of(x, 2)},
                {of(v, 0), of(v, 1), of(v, 2)},
                {of(omega, 0), of(omega, 1), of(omega, 2)},
                carom::Wide::each([&](int lane) { return radius[which[lane]]; })};
    }
    carom::Wide::Type masses(const int *which) const {
        return carom::Wide::each([&](int lane) { return mass[which[lane]]; });
    }
    double radius_of(int i, int j) const {
        return radius[i] * radius[j] / (radius[i] + radius[j]);
    }
};

}  // namespace

/// Tell every sphere, ghosts too, what it weighs with the rigid body that it is part of.
void PairCarom::find_masses() {
    masses.assign(atom->rmass, atom->rmass + atom->nlocal);
    masses.resize(atom->nlocal + atom->nghost);
    for (Fix *fix : rigid) {
        int dimension;
        const int *body = static_cast<int *>(fix->extract("body", dimension));
        const double *whole = static_cast<double *>(fix->extract("masstotal", dimension));
        for (int i = 0; body && whole && i < atom->nlocal; ++i)
            if (body[i] >= 0) masses[i] = whole[body[i]];
    }
    comm->forward_comm(this);
}

int PairCarom::pack_forward_comm(int count, int *atoms, double *buffer, int, int *) {
    for (int k = 0; k < count; ++k) buffer[k] = masses[atoms[k]];
    return count;
}

void PairCarom::unpack_forward_comm(int count, int first, double *buffer) {
    std::copy(buffer, buffer + count, masses.begin() + first);
}

int PairCarom::pack_reverse_comm(int count, int first, double *buffer) {
    return of_spheres.pack(count, first, buffer);
}

void PairCarom::unpack_reverse_comm(int count, int *atoms, double *buffer) {
    of_spheres.unpack(count, atoms, buffer);
}

void PairCarom::compute(int eflag, int vflag) {
    ev_init(eflag, vflag);
    const int nlocal = atom->nlocal;
    if (history->pair != this || history->nlocal_neigh < 0 || history->nlocal_neigh > nlocal)
        error->one(FLERR, "pair_style carom: this LAMMPS keeps histories in another way; build "
                          "the plugin for it: carom lammps build");
    if (!rigid.empty() && neighbor->ago == 0) find_masses();
    std::fill(pvector, pvector + LOSSES, 0.0);
    if (of_spheres.are_kept()) of_spheres.clear_ghosts();
    Meetings met;
    for (int ii = 0; ii < list->inum; ++ii) find_met(list->ilist[ii], met);
    step(met);
    if (of_spheres.are_kept() && force->newton_pair) comm->reverse_comm(this);
    pvector[FRICTION] = losses[FRICTION];
    pvector[VISCOSITY] = losses[VISCOSITY];
    computed = true;
}

/// Collect the neighbors that a sphere touches or has touched, and step them when there are enough.
void PairCarom::find_met(int i, Meetings &met) {
    const int count = list->numneigh[i], length = SPRINGS + kind.doubles;
    const int *neighbors = list->firstneigh[i];
    const double *special = force->special_lj, *radius = atom->radius;
    const carom::Vector here = carom_vector(atom->x[i]);
    double **x = atom->x, *memory = history->firstvalue[i];
    int *touches = history->firstflag[i];
    for (int jj = 0; jj < count; ++jj, ++touches, memory += length) {
        const int j = neighbors[jj] & NEIGHMASK;
        const double reach = radius[i] + radius[j];
        const carom::Vector apart = carom::plus(here, -1.0, carom_vector(x[j]));
        if (carom::dot(apart, apart) >= reach * reach && !*touches) continue;
        if (special[sbmask(neighbors[jj])] == 0.0) continue;
        const int k = met.batch.count++;
        met.one[k] = i;
        met.other[k] = j;
        met.touches[k] = touches;
        met.batch.memories[k] = memory;
        carom_fetch(memory, length);
        if (k + 1 == CaromBatch::most) step(met);
    }
}

/// Bring contacts to the end of the step.
void PairCarom::step(Meetings &met) {
    meet(met);
    if (watch.minimizes())
        carom_press(met.batch);
    else
        carom_step(kind, met.batch, update->setupflag);
    apply(met);
    met.batch.count = 0;
}

/// Tell contacts which bodies meet, and how.
void PairCarom::meet(Meetings &met) {
    CaromBatch &batch = met.batch;
    const Spheres spheres(*atom, rigid.empty() ? atom->rmass : masses.data());
    for (int k = batch.count; k > 0 && k % carom::lanes; ++k) {  // lanes that are left over
        met.one[k] = met.one[k - 1];
        met.other[k] = met.other[k - 1];
    }
    const auto known_of = [&](int k) -> const CaromBodies & {
        return bodies[atom->type[met.one[k]]][atom->type[met.other[k]]];
    };
    carom::Wide::Type radii[CaromBatch::most / carom::lanes], weights[CaromBatch::most / carom::lanes];
    bool is_stiff = false;
    for (int k = 0; k < batch.count; k += carom::lanes) {
        using carom::Wide;
        const carom::Bodies one = spheres.in_lanes(met.one + k);
        const carom::Bodies other = spheres.in_lanes(met.other + k);
        const auto share = Wide::each([&](int lane) { return known_of(k + lane).share; });
        const auto modulus = Wide::each([&](int lane) { return known_of(k + lane).pair.modulus; });
        carom::Encounters &meeting = batch.meetings[k / carom::lanes];
        meeting = carom::encounter(one, other, dt, share);

        const Wide::Type radius = one.radius * other.radius / (one.radius + other.radius);
        const Wide::Type first = spheres.masses(met.one + k), second = spheres.masses(met.other + k);
        const Wide::Type mass = first * second / (first + second);
        is_stiff = is_stiff || carom::is_too_stiff(modulus, radius, mass, meeting.penetration, dt);
        radii[k / carom::lanes] = radius;
        weights[k / carom::lanes] = mass;
    }

    for (int k = 0; k < batch.count; ++k) {
        const int i = met.one[k], j = met.other[k];
        double *memory = batch.memories[k];
        if (!computed && *met.touches[k] && memory[KIND] != kind.number)
            error->one(FLERR, "pair_style carom: contacts remember other springs, another "
                              "precision, part, ledger or losses; give pair_style and pair_coeff "
                              "as they were");
        const CaromBodies &known = known_of(k);
        batch.pairs[k] = known.pair;
        batch.pairs[k].radius = carom::in_lane(radii[k / carom::lanes], k % carom::lanes);
        batch.pairs[k].mass = carom::in_lane(weights[k / carom::lanes], k % carom::lanes);
        if (!*met.touches[k]) {  // what matters at the first touch
            memory[KIND] = kind.number;
            if (known.loss > 0.0) memory[RETARDATION] = carom_retardation(known, batch.pairs[k]);
        }
        if (known.loss > 0.0) batch.pairs[k].retardation = memory[RETARDATION];
        if (known.cohesion) {
            carom::Encounter now = carom::one_of(batch.meetings, k);
            carom_cohere(known.cohesion, batch.pairs[k].radius, now);
            carom::set_one(batch.meetings, k, now);
        }
        const double depth =
            carom::in_lane(batch.meetings[k / carom::lanes].penetration, k % carom::lanes);
        if (is_stiff) watch.press(batch.pairs[k], depth, dt, atom->tag[i], atom->tag[j]);
        if (watch.limits())
            watch.soften(batch.pairs[k], depth, atom->tag[i], atom->tag[j]);
    }
}

/// Add what contacts do; those that end are forgotten.
void PairCarom::apply(Meetings &met) {
    CaromBatch &batch = met.batch;
    const int nlocal = atom->nlocal, newton = force->newton_pair;
    for (int k = 0; k < batch.count; ++k) {
        const int i = met.one[k], j = met.other[k];
        if (batch.statuses[k] != carom::Status::ok)
            watch.check(batch.statuses[k], batch.pairs[k],
                        carom::one_of(batch.meetings, k).penetration, atom->tag[i], atom->tag[j]);
        const bool both = newton || j < nlocal;
        const int lane = k % carom::lanes;
        const carom::Actions &actions = batch.actions[k / carom::lanes];
        const carom::Encounters &meetings = batch.meetings[k / carom::lanes];
        carom::Vector force = carom::in_lane(actions.force, lane);
        const double depth = carom::in_lane(meetings.penetration, lane);
        carom_keep(batch.memories[k], force, depth);
        if (options.tangential) force = carom_aside(force, carom::in_lane(meetings.normal, lane));
        carom_add(atom->f[i], 1.0, force);
        carom_add(atom->torque[i], 1.0, carom::in_lane(actions.torque, lane));
        if (both) {
            carom_add(atom->f[j], -1.0, force);
            carom_add(atom->torque[j], 1.0, carom::in_lane(actions.other_torque, lane));
        }
        if (evflag || options.ledger) tally(met, k, force, both ? 1.0 : 0.5);
        *met.touches[k] = depth > 0.0 && !watch.minimizes();
        if (!*met.touches[k]) std::fill_n(batch.memories[k], SPRINGS + kind.doubles, 0.0);
    }
}

/// Enter energies and the virial; of a pair that two processors compute each has half.
void PairCarom::tally(const Meetings &met, int k, const carom::Vector &f, double share) {
    const carom::Action action = carom::one_of(met.batch.actions, k);
    const double depth = carom::one_of(met.batch.meetings, k).penetration;
    losses[FRICTION] += share * action.friction;
    losses[VISCOSITY] += share * action.viscosity;
    const int i = met.one[k], j = met.other[k];
    if (options.ledger) lose(i, j, action, met.batch.memories[k] + SPRINGS + kind.lost);
    if (!evflag || depth <= 0.0) return;
    double energy = kind.stored(met.batch.memories[k] + SPRINGS);
    if (presses() || (watch.minimizes() && !options.tangential))
        energy += carom_pressed(met.batch.pairs[k], depth);
    pvector[ELASTIC] += share * energy;
    const double *one = atom->x[i], *other = atom->x[j];
    ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, energy, 0.0, f[0], f[1], f[2],
                 one[0] - other[0], one[1] - other[1], one[2] - other[2]);
}

/// Enter what a contact has lost in the step, and half of it with each sphere that is ours.
void PairCarom::lose(int i, int j, const carom::Action &action, double *lost) {
    lost[0] += action.friction;
    lost[1] += action.viscosity;
    if (!of_spheres.are_kept()) return;
    of_spheres.add(i, 0.5 * action.friction, 0.5 * action.viscosity);
    if (force->newton_pair || j < atom->nlocal)
        of_spheres.add(j, 0.5 * action.friction, 0.5 * action.viscosity);
}

/// Return what a pair of neighbours remembers, nullptr if they do not touch.
const double *PairCarom::remembered(int i, int j) const {
    if (i >= atom->nlocal) return nullptr;
    const int *neighbors = list->firstneigh[i];
    for (int jj = 0; jj < list->numneigh[i]; ++jj)
        if ((neighbors[jj] & NEIGHMASK) == j && history->firstflag[i][jj])
            return history->firstvalue[i] + jj * (SPRINGS + kind.doubles);
    return nullptr;
}

/// A contact as last computed: fforce r is the normal force; the other numbers are told by name.
double PairCarom::single(int i, int j, int, int, double rsq, double, double, double &fforce) {
    std::fill(svector, svector + EXTRA, 0.0);
    fforce = 0.0;
    if (!history || !list) return 0.0;
    const double *first = remembered(i, j), *memory = first ? first : remembered(j, i);
    if (!memory) return 0.0;
    const CaromBodies &known = bodies[atom->type[i]][atom->type[j]];
    const Spheres spheres(*atom, nullptr);
    const carom::Encounter now = carom::encounter(spheres.body(i), spheres.body(j), dt, known.share);
    const carom::Vector all = carom::times(first ? 1.0 : -1.0, carom_vector(memory + FORCE));
    const double normal = carom::dot(all, now.normal);
    const carom::Vector aside = carom::plus(all, -normal, now.normal);
    const carom::Vector point = carom::plus(carom_vector(atom->x[i]), -now.arm, now.normal);
    carom::Pair pair = known.pair;
    pair.radius = spheres.radius_of(i, j);
    const double limit = pair.friction * normal;
    fforce = options.tangential ? 0.0 : normal / std::sqrt(rsq);
    std::copy(aside.begin(), aside.end(), svector + ASIDE);
    svector[SIZE] = std::sqrt(carom::dot(aside, aside));
    svector[OVERLAP] = now.penetration;
    svector[MOBILIZED] = limit > 0.0 ? svector[SIZE] / limit : 0.0;
    if (options.ledger) std::copy_n(memory + SPRINGS + kind.lost, 2, svector + BY_FRICTION);
    std::copy(point.begin(), point.end(), svector + POINT);
    return kind.stored(memory + SPRINGS) + (presses() ? carom_pressed(pair, now.penetration) : 0.0);
}

void PairCarom::transfer_history(double *source, double *target, int, int) {
    std::copy(source, source + SPRINGS + kind.doubles, target);
    for (int k = FORCE; k < FORCE + 3; ++k) target[k] = -target[k];
    kind.mirror(target + SPRINGS);
}
