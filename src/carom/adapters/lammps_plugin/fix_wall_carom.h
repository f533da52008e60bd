// fix wall/carom: the exact contact of spheres with the surface of a region, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_FIX_WALL_CAROM_H
#define CAROM_FIX_WALL_CAROM_H

#include <string>
#include <vector>

#include "fix.h"
#include "pair_carom.h"
#include "wall_memories.h"

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
    enum { FORCE_X, ELASTIC = 3, FRICTION, VISCOSITY, SUMS };
    static constexpr int WALL = CaromWallMemories::WALL;

    /// Columns of a sphere are those of LAMMPS' fix wall/gran, a contact has the numbers of both before.
    enum { WALLS, FORCE_ON, POINT = FORCE_ON + 3, RADIUS = POINT + 3, COLUMNS };
    enum { OVERLAP = COLUMNS, STORED, LOST, LOCAL_COLUMNS = LOST + 2 };

    /// Contacts of a step, and whose they are: what is asked of a sphere, as the wall sees it.
    struct Meetings {
        static constexpr int most = CaromBatch::most;
        CaromBatch batch;
        int spheres[most];
        bool is_plain = true;  ///< all have touched before, without cohesion or limits
        double apart[3][most]{}, velocity[3][most]{}, spin[3][most]{}, radius[most]{}, share[most]{};

        Meetings() { std::fill_n(apart[0], most, 1.0); }  // those left over are somewhere
    };
    void read_words(int, char **);
    void find_styles();
    bool lossy() const;
    PairCarom *style_of(int) const;
    bool moves() const;
    void follow();
    bool waits() const;
    void find_near();
    void find_met(int, Meetings &);
    int find_walls(int) const;
    bool touches(int, int, const double *) const;
    bool changes(int, int) const;
    void change(int, int);
    const double *left_for(int, int, int) const;
    void see_begin(const carom::Encounter &, int);
    void see_end(const double *, int);
    double reach_of(int) const;
    void meet(int, int, double *, Meetings &);
    void step(Meetings &);
    void look(Meetings &) const;
    void prepare(Meetings &, int);
    void apply(const Meetings &, int);
    void refuse_misfits() const;
    void show(const Meetings &, int, double);

    std::string name;  ///< of the region
    CaromMaterial material;
    std::vector<CaromBodies> bodies;
    CaromOptions options;
    CaromKind kind;
    CaromWatch watch;
    CaromLosses of_spheres;
    bigint followed;  ///< last step at which the region was asked for its velocity
    std::vector<PairCarom *> styles;  ///< of the spheres: several in a hybrid
    class Region *region;
    bool shows;  ///< contacts one by one, and by atom
    int local_room = 0;
    CaromWallMemories memories;
    std::vector<int> near;  ///< spheres that may meet a wall
    CaromWallMemories::Misfit misfit = CaromWallMemories::NONE;
    double sums[6];  ///< force on the wall; energies: elastic, lost to friction, to viscosity
};

}  // namespace LAMMPS_NS

#endif
