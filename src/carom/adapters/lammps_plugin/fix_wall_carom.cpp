// fix wall/carom: the exact contact of spheres with the surface of a region, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "fix_wall_carom.h"

#include <algorithm>
#include <cmath>

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "region.h"
#include "update.h"

using namespace LAMMPS_NS;

namespace {
enum { FORCE_X, ELASTIC = 3, FRICTION, VISCOSITY, SUMS };
}  // namespace

FixWallCarom::FixWallCarom(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), kind{}, watch(lmp, "fix wall/carom"), followed(-2), region(nullptr),
      memories(nullptr), sums{} {
    if (narg < 7 || std::string(arg[narg - 2]) != "region" || narg % 2 == 0)
        error->all(FLERR, "fix wall/carom: give young, poisson, friction and what else the material "
                          "has, each with a value, and at last region ID");
    name = arg[narg - 1];
    find_styles();
    if (!styles.empty()) options = styles.front()->options;
    read_words(narg - 5, arg + 3);
    region = domain->get_region_by_id(name);
    if (!region) error->all(FLERR, "fix wall/carom: there is no region {}", name);
    if (styles.empty())
        error->all(FLERR, "fix wall/carom needs pair_style carom before it, for the spheres");
    options.viscous = lossy();
    kind = carom_kind(options);
    slots = std::max(region->tmax, 1);
    length = 1 + SPRINGS + kind.doubles;
    maxexchange = slots * length + 1;
    restart_peratom = 1;
    create_attribute = 1;
    vector_flag = extvector = 1;
    size_vector = SUMS;
    global_freq = 1;
    grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
    for (int i = 0; i < atom->nlocal; ++i) set_arrays(i);
}

FixWallCarom::~FixWallCarom() {
    if (copymode) return;
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
    memory->destroy(memories);
}

/// Read the words of the material; the part is that of pair_style carom if none is said.
void FixWallCarom::read_words(int narg, char **arg) {
    std::vector<char *> words;
    bool said = false;
    for (int i = 0; i < narg; i += 2) {
        const std::string word = arg[i], value = arg[i + 1];
        if (word != "part") {
            words.insert(words.end(), {arg[i], arg[i + 1]});
            continue;
        }
        if (said) error->all(FLERR, "fix wall/carom: part {} is given twice", value);
        if (value != "all" && value != "tangential")
            error->all(FLERR, "fix wall/carom: part {} must be all or tangential", value);
        said = true;
        options.tangential = value == "tangential";
    }
    material = carom_material(lmp, "fix wall/carom", static_cast<int>(words.size()), words.data());
    if (!material.complete())
        error->all(FLERR, "fix wall/carom: the wall needs young, poisson and friction");
}

void FixWallCarom::find_styles() {
    styles.clear();
    for (Pair *style : carom_styles(force, "^carom"))
        if (PairCarom *ours = dynamic_cast<PairCarom *>(style)) styles.push_back(ours);
}

/// Return the style that knows the material of a type, nullptr if none does.
PairCarom *FixWallCarom::style_of(int type) const {
    for (PairCarom *style : styles)
        if (style->materials.size() > 1 && style->materials[type][type].complete()) return style;
    return nullptr;
}

int FixWallCarom::setmask() { return FixConst::POST_FORCE; }

void FixWallCarom::init() {
    region = domain->get_region_by_id(name);
    if (!region) error->all(FLERR, "fix wall/carom: there is no region {} any longer", name);
    if (region->nregion > 1 && (region->dynamic || region->varshape))
        error->all(FLERR, "fix wall/carom: LAMMPS has no velocity of region {}, which joins others "
                          "that move; give each of them a fix of its own", name);
    find_styles();
    if (styles.empty()) error->all(FLERR, "fix wall/carom needs pair_style carom, for the spheres");
    if (options.tangential && modify->get_fix_by_style("^wall/gran").empty())
        error->all(FLERR, "fix wall/carom part tangential has no normal force; give fix "
                          "wall/gran/region of the same region, or part all");
    if (lossy() && !options.viscous)
        error->all(FLERR, "fix wall/carom: give pair_coeff, with its losses, before the fix");
    watch.begin();
    bodies.assign(atom->ntypes + 1, CaromBodies{});
    for (int type = 1; type <= atom->ntypes; ++type) {
        const PairCarom *style = style_of(type);
        if (!style) continue;
        const std::string wrong = carom_combine(style->materials[type][type], material,
                                                CaromMaterial{}, bodies[type]);
        if (!wrong.empty())
            error->all(FLERR, "fix wall/carom: of type {} and the wall {}", type, wrong);
        if (bodies[type].cohesion && !options.tangential)
            error->all(FLERR, "fix wall/carom: jkr, dmt and pulloff go with part tangential");
        style->check_steps("fix wall/carom", bodies[type].pair.retardation);
    }
}

/// Whether the wall or any sphere loses energy to viscosity.
bool FixWallCarom::lossy() const {
    for (int type = 1; type <= atom->ntypes; ++type) {
        const PairCarom *style = style_of(type);
        if (style && style->materials[type][type].lossy()) return true;
    }
    return material.lossy();
}

void FixWallCarom::setup(int vflag) { post_force(vflag); }

/// Return the slot of an atom for a wall, a free one if they have not met.
double *FixWallCarom::slot_of(int i, int wall) {
    double *free = nullptr;
    for (int k = 0; k < slots; ++k) {
        double *slot = memories[i] + k * length;
        if (slot[0] == wall + 1.0) return slot;
        if (slot[0] == 0.0 && !free) free = slot;
    }
    return free;
}

/// Return the pair of a sphere and the wall, which is curved by so much (negative if hollow).
carom::Pair FixWallCarom::pair_of(int i, double curved, double *memory) const {
    const CaromBodies &known = bodies[atom->type[i]];
    carom::Pair pair = known.pair;
    const double radius = atom->radius[i];
    pair.radius = curved == 0.0 ? radius : radius * curved / (radius + curved);
    pair.mass = styles.front()->mass_of(i);
    if (known.loss > 0.0) {
        if (!kind.touches(memory + SPRINGS)) memory[RETARDATION] = carom_retardation(known, pair);
        pair.retardation = memory[RETARDATION];
    }
    return pair;
}

void FixWallCarom::post_force(int) {
    std::fill(sums, sums + FRICTION, 0.0);
    region->prematch();
    if (region->dynamic || region->varshape) follow();
    std::vector<double *> touched;
    for (int i = 0; i < atom->nlocal; ++i) {
        if (!(atom->mask[i] & groupbit)) {
            part_all_but({}, i);
            continue;
        }
        const double *x = atom->x[i];
        if (!region->match(x[0], x[1], x[2]))
            error->one(FLERR, "fix wall/carom: atom {} is outside region {}", atom->tag[i], name);
        const int count = region->surface(x[0], x[1], x[2], reach_of(i));
        touched.clear();
        for (int k = 0; k < count; ++k) {
            double *slot = slot_of(i, region->contact[k].iwall);
            if (region->contact[k].r >= atom->radius[i] &&
                !(slot && slot[0] != 0.0 && kind.touches(slot + 1 + SPRINGS)))
                continue;  // a neck is only drawn out by spheres that have touched
            if (!slot) error->one(FLERR, "fix wall/carom: atom {} meets too many walls", atom->tag[i]);
            slot[0] = region->contact[k].iwall + 1.0;
            touched.push_back(slot);
            act(i, k, slot + 1);
        }
        part_all_but(touched, i);
    }
}

/// Let LAMMPS find the velocity of the wall from where it was a step before. Where nobody has looked
/// then, or the wall was displaced between runs, it would take this way for that of a step; a wall
/// starts from rest instead.
void FixWallCarom::follow() {
    const bigint now = update->ntimestep;
    if (update->setupflag || now != followed + 1) update->ntimestep = 0;
    region->set_velocity();
    update->ntimestep = followed = now;
}

/// Let a sphere go from walls that it does not touch.
void FixWallCarom::part_all_but(const std::vector<double *> &touched, int i) {
    for (int k = 0; k < slots; ++k) {
        double *slot = memories[i] + k * length;
        if (slot[0] != 0.0 && std::find(touched.begin(), touched.end(), slot) == touched.end())
            part(slot);
    }
}

/// Let a sphere go; what was still stored is lost at last.
void FixWallCarom::part(double *slot) {
    sums[options.viscous ? VISCOSITY : FRICTION] += kind.stored(slot + 1 + SPRINGS);
    std::fill(slot, slot + length, 0.0);
}

/// Return how far from its centre a sphere meets a wall.
double FixWallCarom::reach_of(int i) const {
    // at a hollow wall R* is larger; the neck goes as its third root
    return atom->radius[i] + 4.0 * carom_neck(bodies[atom->type[i]].cohesion, atom->radius[i]);
}

void FixWallCarom::act(int i, int k, double *memory) {
    const Region::Contact &met = region->contact[k];
    carom::Body wall{};
    const double *x = atom->x[i];
    wall.position = {-met.delx, -met.dely, -met.delz};  // from the sphere, to lose no digits
    if (region->dynamic || region->varshape) {
        double velocity[3] = {0.0, 0.0, 0.0}, place[3] = {x[0], x[1], x[2]};
        region->velocity_contact(velocity, place, k);
        wall.velocity = carom_vector(velocity);
        if (region->rotateflag) wall.spin = carom_vector(region->omega);
    }
    const carom::Body sphere{{0.0, 0.0, 0.0}, carom_vector(atom->v[i]),
                             carom_vector(atom->omega[i]), atom->radius[i]};
    if (memory[KIND] != 0.0 && memory[KIND] != kind.number)
        error->one(FLERR, "fix wall/carom: contacts remember other springs, another precision, ledger "
                          "or losses; give pair_style and pair_coeff as they were");
    CaromBatch batch;
    batch.count = 1;
    batch.memories[0] = memory;
    batch.pairs[0] = pair_of(i, met.radius, memory);
    const CaromBodies &known = bodies[atom->type[i]];
    if (!(known.pair.modulus > 0.0))
        error->one(FLERR, "fix wall/carom: spheres of type {} have no young, poisson or friction; "
                          "give them by pair_coeff {} {} carom", atom->type[i], atom->type[i],
                   atom->type[i]);
    carom::Encounter now = carom::encounter(sphere, wall, update->dt, known.share);
    if (!kind.touches(memory + SPRINGS))
        watch.meet(batch.pairs[0], now, atom->tag[i], CaromWatch::wall);
    if (known.cohesion) carom_cohere(known.cohesion, batch.pairs[0].radius, now);
    watch.soften(batch.pairs[0], now.penetration, atom->tag[i], CaromWatch::wall);
    for (int lane = 0; lane < carom::lanes; ++lane) carom::set_one(batch.meetings, lane, now);
    carom_step(kind, batch, update->setupflag);
    watch.check(batch.statuses[0], batch.pairs[0], now.penetration, atom->tag[i], CaromWatch::wall);
    carom::Action action = carom::one_of(batch.actions, 0);
    if (options.tangential) action.force = carom_aside(action.force, now.normal);
    carom_keep(memory, action.force, now.penetration);
    memory[KIND] = kind.number;
    carom_add(atom->f[i], 1.0, action.force);
    carom_add(atom->torque[i], 1.0, action.torque);
    carom_add(sums + FORCE_X, -1.0, action.force);
    sums[ELASTIC] += kind.stored(memory + SPRINGS);
    if (!options.viscous && !options.tangential)
        sums[ELASTIC] += carom_pressed(batch.pairs[0], now.penetration);
    sums[FRICTION] += action.friction;
    sums[VISCOSITY] += action.viscosity;
}

double FixWallCarom::compute_vector(int n) {
    double all = 0.0;
    MPI_Allreduce(&sums[n], &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

double FixWallCarom::memory_usage() {
    return static_cast<double>(atom->nmax) * slots * length * sizeof(double);
}

void FixWallCarom::grow_arrays(int nmax) {
    memory->grow(memories, nmax, slots * length, "wall/carom:memories");
}

void FixWallCarom::copy_arrays(int i, int j, int) {
    std::copy(memories[i], memories[i] + slots * length, memories[j]);
}

void FixWallCarom::set_arrays(int i) {
    std::fill(memories[i], memories[i] + slots * length, 0.0);
}

int FixWallCarom::pack_exchange(int i, double *buffer) {
    std::copy(memories[i], memories[i] + slots * length, buffer);
    return slots * length;
}

int FixWallCarom::unpack_exchange(int i, double *buffer) {
    std::copy(buffer, buffer + slots * length, memories[i]);
    return slots * length;
}

int FixWallCarom::pack_restart(int i, double *buffer) {
    buffer[0] = slots * length + 1;
    return 1 + pack_exchange(i, buffer + 1);
}

void FixWallCarom::unpack_restart(int i, int nth) {
    double *extra = atom->extra[i];
    int at = 0;
    for (int k = 0; k < nth; ++k) at += static_cast<int>(extra[at]);
    if (static_cast<int>(extra[at]) != slots * length + 1)
        error->one(FLERR, "fix wall/carom: the restart file is of a wall with other springs");
    unpack_exchange(i, extra + at + 1);
}

int FixWallCarom::size_restart(int) { return slots * length + 1; }
int FixWallCarom::maxsize_restart() { return slots * length + 1; }
