// What LAMMPS' own pair_style granular says of its constants, to be compared with ours.
//
// SPDX-License-Identifier: GPL-2.0-only
#ifndef CAROM_GRANULAR_H
#define CAROM_GRANULAR_H

#include <string>
#include <vector>

#include "materials.h"
#include "pair.h"

namespace LAMMPS_NS {

/// The model of two types: of each kind (normal, damping, tangential, ...) a name and its numbers.
struct GranularModel {
    struct Part {
        std::string name;
        std::vector<double> numbers;
    };
    std::vector<Part> parts;
};

/// All that a pair_style granular was given by pair_coeff.
class GranularConstants {
  public:
    /// Read what the style would write into a restart file: LAMMPS shows it in no other way.
    GranularConstants(Pair *, int types);

    bool readable = false;
    bool has(int i, int j) const { return of(i, j) != nullptr; }

    /// Return what differs from what we were given for two types, in a line; empty if nothing.
    std::string difference(int i, int j, const CaromMaterial &own, const CaromBodies &) const;

  private:
    const GranularModel *of(int i, int j) const;  ///< nullptr if none was said

    std::vector<GranularModel> models;
    std::vector<std::vector<int>> which;
};

}  // namespace LAMMPS_NS

#endif
