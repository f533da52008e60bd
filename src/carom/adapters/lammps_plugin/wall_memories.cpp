// What spheres remember of walls, for LAMMPS.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "wall_memories.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {
constexpr double restart_format = 2000001.0;  // raised when what a restart file holds changes
}

void CaromWallMemories::begin(const CaromKind &kind) {
    number = kind.number;
    size = SPRINGS + kind.doubles;
}

const double *CaromWallMemories::of(int i, int wall) const {
    for (const double *memory = first(i); memory != end(i); memory += size)
        if (memory[WALL] == wall) return memory;
    return nullptr;
}

void CaromWallMemories::add(std::vector<double> &list, int wall, const double *memory) const {
    const std::size_t at = list.size();
    list.reserve(at + size);  // not more
    list.resize(at + size, 0.0);
    if (memory) std::copy(memory, memory + size, &list[at]);
    list[at + WALL] = wall;
}

int CaromWallMemories::pack(int i, double *buffer) const {
    buffer[0] = 1 + held(i);
    std::copy(first(i), end(i), buffer + 1);
    return 1 + held(i);
}

int CaromWallMemories::unpack(int i, const double *buffer) {
    const int count = static_cast<int>(buffer[0]);
    std::vector<double>(buffer + 1, buffer + count).swap(all[i]);
    return count;
}

int CaromWallMemories::pack_restart(int i, double *buffer) const {
    buffer[0] = restart_size(i);
    if (all[i].empty()) return 1;
    buffer[1] = restart_format;
    buffer[2] = number;
    std::copy(first(i), end(i), buffer + HEADER);
    return restart_size(i);
}

CaromWallMemories::Misfit CaromWallMemories::unpack_restart(int i, const double *buffer) {
    const int count = static_cast<int>(buffer[0]);
    clear(i);
    if (count == 1) return NONE;
    if (count < HEADER || buffer[1] != restart_format) return OTHER_VERSION;
    if (buffer[2] != number || (count - HEADER) % size != 0) return OTHER_KIND;
    all[i].assign(buffer + HEADER, buffer + count);
    return NONE;
}

std::size_t CaromWallMemories::bytes() const {
    std::size_t numbers = 0;
    for (const std::vector<double> &each : all) numbers += each.capacity();
    return numbers * sizeof(double) + all.capacity() * sizeof(std::vector<double>);
}
