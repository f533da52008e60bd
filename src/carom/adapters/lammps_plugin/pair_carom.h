// pair_style carom: the exact contact of spheres, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_PAIR_CAROM_H
#define CAROM_PAIR_CAROM_H

#include <string>
#include <vector>

#include "atom.h"
#include "fix.h"
#include "granular.h"
#include "kinds.h"
#include "losses.h"
#include "materials.h"
#include "pair.h"
#include "watch.h"

namespace LAMMPS_NS {

/// The leading members of LAMMPS' fix NEIGH_HISTORY, whose header it does not install.
class NeighHistory : public Fix {
  public:
    int nlocal_neigh, nall_neigh, use_bit_flag;
    int **firstflag;
    double **firstvalue;
    class Pair *pair;
};

CaromMaterial carom_material(class LAMMPS *, const char *where, int, char **);

/// Return all pair styles of a name, of a hybrid or alone.
std::vector<class Pair *> carom_styles(class Force *, const char *name);

class PairCarom : public Pair {
  public:
    explicit PairCarom(class LAMMPS *);
    ~PairCarom() override;
    void settings(int, char **) override;
    void coeff(int, char **) override;
    void init_style() override;
    double init_one(int, int) override;
    void compute(int, int) override;
    double single(int, int, int, int, double, double, double, double &) override;
    void transfer_history(double *, double *, int, int) override;
    void write_restart(FILE *) override;
    void read_restart(FILE *) override;
    void write_restart_settings(FILE *) override;
    void read_restart_settings(FILE *) override;
    void reset_dt() override;
    int pack_forward_comm(int, int *, double *, int, int *) override;
    void unpack_forward_comm(int, int, double *) override;
    int pack_reverse_comm(int, int, double *) override;
    void unpack_reverse_comm(int, int *, double *) override;

    void check_steps(const char *, double) const;

    /// What a sphere weighs, with the rigid body that it is part of.
    double mass_of(int i) const { return rigid.empty() ? atom->rmass[i] : masses[i]; }

    std::vector<std::vector<CaromMaterial>> materials;  ///< of types, and said of two types
    CaromOptions options;

  private:
    enum { ELASTIC, FRICTION, VISCOSITY, LOSSES };
    /// What `single` tells besides energy and normal force.
    enum { ASIDE, SIZE = 3, OVERLAP, MOBILIZED, BY_FRICTION, BY_VISCOSITY, POINT, EXTRA = POINT + 3 };

    /// Contacts of a step, and whose they are.
    struct Meetings {
        CaromBatch batch;
        int one[CaromBatch::most], other[CaromBatch::most];
        int *touches[CaromBatch::most];
    };
    void allocate();
    void require() const;
    void require_material(int) const;
    void read_granular();
    void compare(int, int) const;
    void shrink_pages();
    void fit_pages();
    void find_radii();
    void find_masses();
    void find_met(int, Meetings &);
    void step(Meetings &);
    void meet(Meetings &);
    void apply(Meetings &);
    void tally(const Meetings &, int, const carom::Vector &, double);
    void lose(int, int, const carom::Action &, double *);
    const double *remembered(int, int) const;
    bool presses() const { return !options.viscous && !options.tangential; }
    void read(FILE *, void *, int);

    CaromWatch watch;
    CaromKind kind;
    std::vector<std::vector<CaromBodies>> bodies;
    std::vector<double> radii, masses;
    std::vector<class Fix *> rigid;
    double losses[LOSSES] = {0.0, 0.0, 0.0};
    CaromLosses of_spheres;
    std::vector<GranularConstants> beside;  ///< of the styles that give the normal force
    bool beside_read = false;
    std::string history_id;
    NeighHistory *history;
    int stored_doubles = 0;  ///< of a contact, as the history was made
    double dt;
    bool computed = false;  ///< since LAMMPS was set up
};

}  // namespace LAMMPS_NS

#endif
