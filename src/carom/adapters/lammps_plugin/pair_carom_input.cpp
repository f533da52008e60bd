// What an input and a restart file say of pair_style carom.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "pair_carom.h"

#include <algorithm>
#include <string>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

using namespace LAMMPS_NS;

namespace {
constexpr int restart_format = 1000004;  // raised when what a restart file holds changes
constexpr int small_page = 20000;        // what LAMMPS' default of `one` needs
}  // namespace

/// Read words with values, or stop LAMMPS with a line that begins with `where`.
CaromMaterial LAMMPS_NS::carom_material(LAMMPS *lmp, const char *where, int narg, char **arg) {
    CaromMaterial given;
    for (int i = 0; i + 1 < narg; i += 2) {
        const double value = utils::numeric(FLERR, arg[i + 1], false, lmp);
        const std::string wrong = carom_read(given, arg[i], value);
        if (!wrong.empty())
            lmp->error->all(FLERR, "{}: {} {} {}", where, arg[i], arg[i + 1], wrong);
    }
    const std::string flaw = carom_flaw(given);
    if (!flaw.empty()) lmp->error->all(FLERR, "{}: {}", where, flaw);
    return given;
}

std::vector<Pair *> LAMMPS_NS::carom_styles(Force *force, const char *name) {
    std::vector<Pair *> styles;
    for (int n = 1;; ++n) {
        Pair *style = force->pair_match(name, 0, n);
        if (!style || (!styles.empty() && style == styles.back())) return styles;
        styles.push_back(style);
    }
}

PairCarom::PairCarom(LAMMPS *lmp)
    : Pair(lmp), watch(lmp, "pair_style carom"), kind{}, of_spheres(lmp),
      history_id("NEIGH_HISTORY_CAROM"), history(nullptr), dt(0.0) {
    single_enable = 1;
    single_extra = EXTRA;
    svector = new double[single_extra];
    no_virial_fdotr_compute = 1;
    centroidstressflag = CENTROID_NOTAVAIL;
    finitecutflag = 1;
    restartinfo = 1;
    nondefault_history_transfer = 1;
    comm_forward = 1;
    comm_reverse = 2;
    nextra = LOSSES;
    pvector = new double[LOSSES]();
    // holds the place of the history among the fixes, as it must come before those that move atoms
    for (int n = 2; modify->get_fix_by_id(history_id) || modify->get_fix_by_id(history_id + "_DUMMY");
         ++n)
        history_id = fmt::format("NEIGH_HISTORY_CAROM_{}", n);  // of another carom in a hybrid
    modify->add_fix(history_id + "_DUMMY all DUMMY");
    shrink_pages();
}

PairCarom::~PairCarom() {
    delete[] svector;
    delete[] pvector;
    if (copymode) return;
    modify->delete_fix(history ? history_id : history_id + "_DUMMY");
    if (allocated) {
        memory->destroy(setflag);
        memory->destroy(cutsq);
    }
}

void PairCarom::allocate() {
    const int n = atom->ntypes;
    allocated = 1;
    memory->create(setflag, n + 1, n + 1, "pair:setflag");
    memory->create(cutsq, n + 1, n + 1, "pair:cutsq");
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) setflag[i][j] = 0;
    materials.assign(n + 1, std::vector<CaromMaterial>(n + 1));
    bodies.assign(n + 1, std::vector<CaromBodies>(n + 1));
}

void PairCarom::settings(int narg, char **arg) {
    options = CaromOptions{};
    for (int i = 0; i < narg; i += 2) {
        const std::string name = arg[i];
        if (i + 1 >= narg) error->all(FLERR, "pair_style carom: {} wants a value", name);
        for (int k = 0; k < i; k += 2)
            if (name == arg[k]) error->all(FLERR, "pair_style carom: {} is given twice", name);
        const std::string value = arg[i + 1];
        if (name == "springs") {
            options.springs = utils::inumeric(FLERR, arg[i + 1], false, lmp);
        } else if (name == "precision" && (value == "single" || value == "double")) {
            options.single = value == "single";
        } else if (name == "ledger") {
            options.ledger = utils::logical(FLERR, arg[i + 1], false, lmp);
        } else if (name == "part" && (value == "all" || value == "tangential")) {
            options.tangential = value == "tangential";
        } else {
            error->all(FLERR,
                       "pair_style carom: {} {} is not known; springs 16, 32 or 64, precision "
                       "single or double, ledger yes or no, part all or tangential",
                       name, value);
        }
    }
    if (carom_kind(options).doubles == 0)
        error->all(FLERR, "pair_style carom: springs {} must be 16, 32 or 64", options.springs);
}

void PairCarom::coeff(int narg, char **arg) {
    if (!allocated) allocate();
    if (narg < 4 || narg % 2)
        error->all(FLERR,
                   "pair_coeff of carom: give types, then young, poisson, friction, and retardation "
                   "or restitution and speed, each with a value");
    int ilo, ihi, jlo, jhi;
    utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
    utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);
    const CaromMaterial given = carom_material(lmp, "pair_coeff of carom", narg - 2, arg + 2);
    const bool coheres = given.jkr >= 0.0 || given.dmt >= 0.0 || given.pulloff >= 0.0;
    if (coheres && !options.tangential)
        error->all(FLERR, "pair_coeff of carom: jkr, dmt and pulloff go with part tangential, beside "
                          "a pair_style that has such a normal force");
    for (int i = ilo; i <= ihi; ++i)
        for (int j = std::max(jlo, i); j <= jhi; ++j) {
            materials[i][j] = given;  // whole: nothing of a line before is left
            setflag[i][j] = 1;
        }
}

void PairCarom::require() const {
    if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
        error->all(FLERR, "pair_style carom needs spheres: atom_style sphere");
    if (!comm->ghost_velocity)
        error->all(FLERR, "pair_style carom needs velocities of ghosts: comm_modify vel yes");
    const std::string units = update->unit_style;
    if (units != "si" && units != "cgs" && units != "lj" && units != "micro" && units != "nano")
        error->all(FLERR, "pair_style carom needs units si, cgs, lj, micro or nano, not {}", units);
    if (options.tangential && force->pair == this)
        error->all(FLERR, "pair_style carom part tangential has no normal force; give pair_style "
                          "hybrid/overlay granular carom part tangential");
    for (int i = 1; force->pair == this && i <= atom->ntypes; ++i) require_material(i);
}

void PairCarom::require_material(int type) const {
    if (!materials[type][type].complete())
        error->all(FLERR,
                   "pair_style carom: type {} has no young, poisson or friction; give them by "
                   "pair_coeff {} {}",
                   type, type, type);
}

void PairCarom::init_style() {
    if (!allocated) error->all(FLERR, "pair_style carom: give coefficients by pair_coeff");
    require();
    options.viscous = false;
    for (const auto &row : materials)
        for (const CaromMaterial &one : row)
            if (one.lossy()) options.viscous = true;
    kind = carom_kind(options);
    computed = false;
    watch.begin();
    if (force->pair == this || modify->nfix_restart_peratom == 0)
        fit_pages();  // what others of a hybrid have restarted lies in theirs
    of_spheres.begin("pair_style carom", options.ledger);
    neighbor->add_request(this, NeighConst::REQ_SIZE | NeighConst::REQ_HISTORY);
    dt = update->dt;
    rigid.clear();
    for (Fix *fix : modify->get_fix_list())
        if (fix->rigid_flag) rigid.push_back(fix);
    beside_read = false;
    const bool asked = !modify->get_compute_by_style("^pair$").empty() && !watch.minimizes();
    if (asked && options.viscous && !options.ledger && !options.tangential && comm->me == 0)
        error->warning(FLERR, "pair_style carom: with losses, energies of contacts are told by "
                              "ledger yes only; pe and compute pair are 0 now");
    if (history && stored_doubles != kind.doubles)
        error->all(FLERR, "pair_style carom: losses cannot be switched on or off between runs; give "
                          "them by pair_coeff before the first run");
    stored_doubles = kind.doubles;
    if (!history) {
        const auto command =
            fmt::format("{} all NEIGH_HISTORY {}", history_id, SPRINGS + kind.doubles);
        history =
            static_cast<NeighHistory *>(modify->replace_fix(history_id + "_DUMMY", command, 1));
        history->pair = this;
        history->use_bit_flag = 0;
    }
    find_radii();
}

/// Keep histories in small pages unless the input says how large, behind pair_style: each is made whole,
/// also for few spheres.
void PairCarom::shrink_pages() {
    constexpr int usual = 100000;  // LAMMPS' default
    if (neighbor->pgsize == usual) neighbor->pgsize = small_page;
}

/// A sphere may have `one` neighbours, of which LAMMPS wants ten times as many in a page.
void PairCarom::fit_pages() {
    int &page = neighbor->pgsize;
    if (page == small_page) page = std::max(10 * neighbor->oneatom, small_page);
}

void PairCarom::find_radii() {
    std::vector<double> mine(atom->ntypes + 1, 0.0);
    for (int i = 0; i < atom->nlocal; ++i)
        mine[atom->type[i]] = std::max(mine[atom->type[i]], atom->radius[i]);
    for (auto &fix : modify->get_fix_list())  // of spheres that are still to come
        for (int type = 1; type <= atom->ntypes; ++type) {
            int of_type = type;
            void *radius = fix->extract("radius", of_type);
            if (radius) mine[type] = std::max(mine[type], *static_cast<double *>(radius));
        }
    radii.assign(mine.size(), 0.0);
    MPI_Allreduce(mine.data(), radii.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_MAX,
                  world);
}

/// Single precision holds what springs of a contact move in a step, if it is not too small a part.
void PairCarom::check_steps(const char *where, double retardation) const {
    if (options.single && retardation > 1e7 * update->dt)
        error->all(FLERR, "{}: retardation {} is above 1e7 time steps, too long for precision single; "
                          "give pair_style carom precision double", where, retardation);
}

/// Read what granular styles say of the constants of both.
void PairCarom::read_granular() {
    beside.clear();
    for (Pair *style : carom_styles(force, "^granular"))
        beside.emplace_back(style, atom->ntypes);
    for (const GranularConstants &each : beside)
        if (!each.readable && comm->me == 0)
            error->warning(FLERR, "pair_style carom: this LAMMPS writes the constants of granular in "
                                  "another way, they are not compared with those of carom");
    if (beside.empty() && carom_styles(force, "^gran").empty())
        error->all(FLERR, "pair_style carom part tangential: no other style gives a normal force; "
                          "give pair_style hybrid/overlay granular carom part tangential");
    if (beside.empty() && comm->me == 0)
        error->warning(FLERR, "pair_style carom: only constants of granular are compared with ours; see "
                              "to it that those of the other style agree, and its friction is 0");
    beside_read = true;
}

/// Stop LAMMPS if what stands in two pair_coeff lines differs.
void PairCarom::compare(int i, int j) const {
    std::string wrong;
    for (const GranularConstants &each : beside) {
        wrong = each.readable ? each.difference(i, j, materials[i][j], bodies[i][j]) : "";
        if (wrong.empty() || each.has(i, j)) break;
    }
    if (!wrong.empty())
        error->all(FLERR, "pair_style carom part tangential: types {} and {}: {}", i, j, wrong);
}

double PairCarom::init_one(int i, int j) {
    if (i == j || !materials[i][j].complete()) {
        require_material(i);
        require_material(j);
    }
    const std::string wrong =
        carom_combine(materials[i][i], materials[j][j], materials[i][j], bodies[i][j]);
    if (!wrong.empty())
        error->all(FLERR, "pair_style carom: of types {} and {} {}; say by pair_coeff {} {} what "
                          "holds for both", i, j, wrong, i, j);
    if (options.tangential) {
        if (!beside_read) read_granular();
        compare(i, j);
    }
    check_steps("pair_style carom", bodies[i][j].pair.retardation);
    bodies[j][i] = bodies[i][j];
    bodies[j][i].share = 1.0 - bodies[i][j].share;
    return radii[i] + radii[j] + carom_neck(bodies[i][j].cohesion, std::max(radii[i], radii[j]));
}

void PairCarom::reset_dt() { dt = update->dt; }

/// LAMMPS wraps atoms before `write_restart`, and then reads its list of neighbors once more, which
/// does not fit any longer.
void PairCarom::write_restart(FILE *file) {
    if (!computed && (domain->xperiodic || domain->yperiodic || domain->zperiodic))
        error->warning(FLERR, "pair_style carom: contacts across periodic borders are forgotten now "
                              "and in the restart; keep them by: write_restart FILE noinit");
    write_restart_settings(file);
    for (int i = 1; i <= atom->ntypes; ++i)
        for (int j = i; j <= atom->ntypes; ++j) {
            fwrite(&setflag[i][j], sizeof(int), 1, file);
            fwrite(&materials[i][j], sizeof(CaromMaterial), 1, file);
        }
}

void PairCarom::read_restart(FILE *file) {
    read_restart_settings(file);
    allocate();
    for (int i = 1; i <= atom->ntypes; ++i)
        for (int j = i; j <= atom->ntypes; ++j) {
            read(file, &setflag[i][j], sizeof(int));
            read(file, &materials[i][j], sizeof(CaromMaterial));
        }
}

void PairCarom::write_restart_settings(FILE *file) {
    fwrite(&restart_format, sizeof(int), 1, file);
    fwrite(&options, sizeof(CaromOptions), 1, file);
}

void PairCarom::read_restart_settings(FILE *file) {
    int format = 0;
    read(file, &format, sizeof(int));
    if (format != restart_format)
        error->all(FLERR, "pair_style carom: the restart file is of another version of Carom; go on "
                          "from it with that version, or from a data file");
    read(file, &options, sizeof(CaromOptions));
}

/// Read on the first processor, and tell all.
void PairCarom::read(FILE *file, void *target, int size) {
    if (comm->me == 0) utils::sfread(FLERR, target, 1, size, file, nullptr, error);
    MPI_Bcast(target, size, MPI_CHAR, 0, world);
}
