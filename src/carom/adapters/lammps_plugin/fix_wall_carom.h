// fix wall/carom: the exact contact of spheres with the surface of a region, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_FIX_WALL_CAROM_H
#define CAROM_FIX_WALL_CAROM_H

#include <string>
#include <vector>

#include "fix.h"
#include "pair_carom.h"

namespace LAMMPS_NS {

class FixWallCarom : public Fix {
  public:
    FixWallCarom(class LAMMPS *, int, char **);
    ~FixWallCarom() override;
    int setmask() override;
    void init() override;
    void setup(int) override;
    void post_force(int) override;
    double compute_vector(int) override;
    double memory_usage() override;
    void grow_arrays(int) override;
    void copy_arrays(int, int, int) override;
    void set_arrays(int) override;
    int pack_exchange(int, double *) override;
    int unpack_exchange(int, double *) override;
    int pack_restart(int, double *) override;
    void unpack_restart(int, int) override;
    int size_restart(int) override;
    int maxsize_restart() override;

  private:
    void read_words(int, char **);
    void find_styles();
    bool lossy() const;
    double *slot_of(int, int);
    PairCarom *style_of(int) const;
    carom::Pair pair_of(int, double, double *) const;
    void follow();
    double reach_of(int) const;
    void act(int, int, double *);
    void part_all_but(const std::vector<double *> &, int);
    void part(double *);

    std::string name;  ///< of the region
    CaromMaterial material;
    std::vector<CaromBodies> bodies;
    CaromOptions options;
    CaromKind kind;
    CaromWatch watch;
    bigint followed;  ///< last step at which the region was asked for its velocity
    std::vector<PairCarom *> styles;  ///< of the spheres: several in a hybrid
    class Region *region;
    double **memories;  ///< slots of each atom: the wall's number and 1, then a contact
    int slots, length;
    double sums[6];  ///< force on the wall; energies: elastic, lost to friction, to viscosity
};

}  // namespace LAMMPS_NS

#endif
