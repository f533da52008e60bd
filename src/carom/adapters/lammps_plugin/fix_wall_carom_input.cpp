// What an input and a restart file say of fix wall/carom.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "fix_wall_carom.h"

#include <string>

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "region.h"

using namespace LAMMPS_NS;

FixWallCarom::FixWallCarom(LAMMPS *lmp, int narg, char **arg)
    : Fix(lmp, narg, arg), kind{}, watch(lmp, "fix wall/carom"), of_spheres(lmp), followed(-2),
      region(nullptr),
      shows(narg > 5 && std::string(arg[narg - 1]) == "contacts" &&
            std::string(arg[narg - 2]) != "region"),
      sums{} {
    if (shows) --narg;
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
    memories.begin(kind);
    maxexchange = 1 + region->cmax * memories.length();
    restart_peratom = 1;
    create_attribute = 1;
    vector_flag = extvector = 1;
    size_vector = SUMS;
    global_freq = 1;
    if (shows) {
        peratom_flag = local_flag = peratom_freq = local_freq = 1;
        size_peratom_cols = COLUMNS;
        size_local_cols = LOCAL_COLUMNS;
        size_local_rows = 0;
    }
    grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
}

FixWallCarom::~FixWallCarom() {
    if (copymode) return;
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
    memory->destroy(array_atom);
    memory->destroy(array_local);
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
    refuse_misfits();
    region = domain->get_region_by_id(name);
    if (!region) error->all(FLERR, "fix wall/carom: there is no region {} any longer", name);
    if (region->nregion > 1 && (region->dynamic || region->varshape))
        error->all(FLERR, "fix wall/carom: LAMMPS has no velocity of region {}, which joins others "
                          "that move; give each of them a fix of its own", name);
    maxexchange = 1 + region->cmax * memories.length();
    find_styles();
    if (styles.empty()) error->all(FLERR, "fix wall/carom needs pair_style carom, for the spheres");
    if (options.tangential && modify->get_fix_by_style("^wall/gran").empty())
        error->all(FLERR, "fix wall/carom part tangential has no normal force; give fix "
                          "wall/gran/region of the same region, or part all");
    if (lossy() && !options.viscous)
        error->all(FLERR, "fix wall/carom: give pair_coeff, with its losses, before the fix");
    watch.begin();
    of_spheres.begin("fix wall/carom", options.ledger);
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

double FixWallCarom::compute_vector(int n) {
    double all = 0.0;
    MPI_Allreduce(&sums[n], &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

double FixWallCarom::memory_usage() {
    const std::size_t shown = shows ? atom->nmax * COLUMNS + local_room * LOCAL_COLUMNS : 0;
    return static_cast<double>(memories.bytes() + near.capacity() * sizeof(int) +
                               shown * sizeof(double));
}

void FixWallCarom::grow_arrays(int nmax) {
    memories.grow(nmax);
    if (!shows) return;
    memory->grow(array_atom, nmax, COLUMNS, "wall/carom:atom");
    std::fill_n(*array_atom, nmax * COLUMNS, 0.0);
}

void FixWallCarom::copy_arrays(int i, int j, int) { memories.copy(i, j); }
void FixWallCarom::set_arrays(int i) { memories.clear(i); }
int FixWallCarom::pack_exchange(int i, double *buffer) { return memories.pack(i, buffer); }
int FixWallCarom::unpack_exchange(int i, double *buffer) { return memories.unpack(i, buffer); }
int FixWallCarom::pack_restart(int i, double *buffer) { return memories.pack_restart(i, buffer); }

void FixWallCarom::unpack_restart(int i, int nth) {
    const double *extra = atom->extra[i];
    for (int k = 0; k < nth; ++k) extra += static_cast<int>(extra[0]);
    misfit = std::max(misfit, memories.unpack_restart(i, extra));
}

int FixWallCarom::size_restart(int i) { return memories.restart_size(i); }
int FixWallCarom::maxsize_restart() { return memories.largest_restart(region->cmax); }

/// Stop LAMMPS if any processor has read what is no memory of these contacts.
void FixWallCarom::refuse_misfits() const {
    int mine = misfit, worst = 0;
    MPI_Allreduce(&mine, &worst, 1, MPI_INT, MPI_MAX, world);
    if (worst == CaromWallMemories::OTHER_VERSION)
        error->all(FLERR, "fix wall/carom: the restart file is of another version of Carom; go on from "
                          "it with that version, or from a data file");
    if (worst == CaromWallMemories::OTHER_KIND)
        error->all(FLERR, "fix wall/carom: contacts in the restart file remember other springs, "
                          "another precision, ledger or losses; give pair_style and pair_coeff as "
                          "they were");
}
