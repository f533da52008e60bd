// What spheres remember of walls: each of those that it touches, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_WALL_MEMORIES_H
#define CAROM_WALL_MEMORIES_H

#include <cstddef>
#include <vector>

#include "kinds.h"

namespace LAMMPS_NS {

/// Contacts of one kind as in kinds.h, with the wall's number in place of the kind.
class CaromWallMemories {
  public:
    static constexpr int WALL = KIND;

    void begin(const CaromKind &);

    int length() const { return size; }

    double *first(int i) { return all[i].data(); }
    double *end(int i) { return all[i].data() + all[i].size(); }
    const double *first(int i) const { return all[i].data(); }
    const double *end(int i) const { return all[i].data() + all[i].size(); }

    /// Return what an atom remembers of a wall, nullptr if they do not touch.
    const double *of(int i, int wall) const;

    /// Add what an atom remembers of a wall, all zeros, or as it was, to a list.
    void add(std::vector<double> &list, int wall, const double *memory) const;

    /// Put a list in place of what an atom remembers, which is returned.
    void swap(int i, std::vector<double> &list) { all[i].swap(list); }

    // As LAMMPS calls them for each atom; a buffer begins with its size.
    void grow(int atoms) { all.resize(atoms); }
    void copy(int i, int j) { std::vector<double>(all[i]).swap(all[j]); }  // no larger than it is
    void clear(int i) { std::vector<double>().swap(all[i]); }
    int pack(int i, double *buffer) const;
    int unpack(int i, const double *buffer);
    int restart_size(int i) const { return all[i].empty() ? 1 : HEADER + held(i); }
    int largest_restart(int walls) const { return HEADER + walls * size; }
    int pack_restart(int i, double *buffer) const;

    /// Why a restart file cannot be read.
    enum Misfit { NONE, OTHER_KIND, OTHER_VERSION };
    Misfit unpack_restart(int i, const double *buffer);

    std::size_t bytes() const;

  private:
    static constexpr int HEADER = 3;  // size, format, kind: of atoms that touch

    int held(int i) const { return static_cast<int>(all[i].size()); }

    std::vector<std::vector<double>> all;
    double number = 0.0;
    int size = 0;
};

}  // namespace LAMMPS_NS

#endif
