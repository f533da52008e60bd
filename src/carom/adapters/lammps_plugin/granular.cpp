// What LAMMPS' own pair_style granular says of its constants, to be compared with ours.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "granular.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fmt/format.h"

namespace LAMMPS_NS {
namespace {

enum { NORMAL, DAMPING, TANGENTIAL, ROLLING, TWISTING, HEAT, PARTS };

/// Numbers one after the other, as a file holds them.
struct Reader {
    const char *at, *end;
    bool good = true;

    void take(void *target, size_t size) {
        good = good && size <= static_cast<size_t>(end - at);
        if (!good) return;
        std::memcpy(target, at, size);
        at += size;
    }
    int count(int most) {
        int value = 0;
        take(&value, sizeof value);
        good = good && value >= 0 && value <= most;
        return good ? value : 0;
    }
    GranularModel::Part part() {
        GranularModel::Part part;
        part.name.resize(count(99));
        take(&part.name[0], part.name.size());
        part.numbers.resize(count(99));
        take(part.numbers.data(), part.numbers.size() * sizeof(double));
        return part;
    }
};

/// Whether numbers differ by more than means that were typed by hand.
bool differs(double one, double other) {
    return std::fabs(one - other) > 1e-4 * std::fmax(std::fabs(one), std::fabs(other));
}

bool is_one_of(const std::string &name, std::initializer_list<const char *> names) {
    for (const char *each : names)
        if (name == each) return true;
    return false;
}

/// Return the constants of a model in our words.
CaromMaterial material_of(const GranularModel &model) {
    const GranularModel::Part &normal = model.parts[NORMAL], &tangential = model.parts[TANGENTIAL];
    CaromMaterial material;
    if (normal.name != "hertz" && normal.numbers.size() >= 3) {
        material.young = normal.numbers[0];
        material.poisson = normal.numbers[2];
    }
    if (normal.numbers.size() >= 4 && normal.numbers[3] > 0.0)
        (normal.name == "jkr" ? material.jkr : material.dmt) = normal.numbers[3];
    if (tangential.numbers.size() == 2) material.friction = tangential.numbers[1];
    return material;
}

/// Return why friction by springs cannot stand beside a model, empty if it can.
std::string refusal_of(const GranularModel &model) {
    const GranularModel::Part &normal = model.parts[NORMAL], &tangential = model.parts[TANGENTIAL];
    if (!is_one_of(normal.name, {"hertz", "hertz/material", "dmt", "jkr"}))
        return fmt::format("granular's normal force is {}, which has no depth of Hertz; hertz, "
                           "hertz/material, dmt and jkr have", normal.name);
    if (!is_one_of(tangential.name, {"none", "linear_nohistory"}) ||
        (!tangential.numbers.empty() && tangential.numbers[0] != 0.0))
        return fmt::format("granular has a friction of its own, {}; give it tangential "
                           "linear_nohistory 0.0 and the friction coefficient", tangential.name);
    if (model.parts[TWISTING].name == "marshall")
        return "granular's twisting marshall has no stiffness without a tangential spring of its own; "
               "give twisting sds";
    return "";
}

std::string unlike(const char *what, double here, double there) {
    return fmt::format("{} is {:.10g} here and {:.10g} in pair_coeff of granular; give both the same",
                       what, here, there);
}

const char *name_of(const CaromCohesion &cohesion) {
    const char *names[] = {"none", "jkr", "dmt", "pulloff"};
    return names[cohesion.kind];
}

}  // namespace

GranularConstants::GranularConstants(Pair *style, int types)
    : which(types + 1, std::vector<int>(types + 1, -1)) {
    char *text = nullptr;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file) return;
    style->write_restart(file);
    fclose(file);
    Reader reader{text, text + size};
    models.resize(reader.count(1000000));
    for (GranularModel &model : models) {
        for (int k = 0; k < PARTS; ++k) model.parts.push_back(reader.part());
        reader.count(1);  // whether damping is limited
    }
    for (int i = 1; i <= types; ++i)
        for (int j = i; j <= types; ++j) {
            double cutoff;
            if (!reader.count(1)) continue;
            reader.take(&cutoff, sizeof cutoff);
            which[i][j] = reader.count(static_cast<int>(models.size()) - 1);
        }
    readable = reader.good && reader.at == reader.end;
    free(text);
}

const GranularModel *GranularConstants::of(int i, int j) const {
    const int model = which[i][j];
    return model < 0 ? nullptr : &models[model];
}

std::string GranularConstants::difference(int i, int j, const CaromMaterial &own,
                                          const CaromBodies &ours) const {
    const GranularModel *model = of(i, j);  // said: LAMMPS mixes no types that two styles share
    if (!model) return "granular has no pair_coeff for them";
    const std::string refusal = refusal_of(*model);
    if (!refusal.empty()) return refusal;
    const CaromMaterial both = material_of(*model);
    CaromBodies theirs;
    carom_combine(both, both, both, theirs);
    if (model->parts[NORMAL].name == "hertz")
        theirs.pair.modulus = 0.75 * model->parts[NORMAL].numbers[0];
    else if (i == j && differs(own.young, both.young))
        return unlike("young", own.young, both.young);
    else if (i == j && differs(own.poisson, both.poisson))
        return unlike("poisson", own.poisson, both.poisson);
    if (differs(ours.pair.modulus, theirs.pair.modulus))
        return unlike("E*, of young and poisson,", ours.pair.modulus, theirs.pair.modulus);
    if (both.friction >= 0.0 && differs(ours.pair.friction, theirs.pair.friction))
        return unlike("friction", ours.pair.friction, theirs.pair.friction);
    if (ours.cohesion.kind == CaromCohesion::pulloff && theirs.cohesion.kind == CaromCohesion::none)
        return "";  // that of some other style
    if (ours.cohesion.kind != theirs.cohesion.kind)
        return fmt::format("their cohesion is {} here and {} in pair_coeff of granular; give both "
                           "the same", name_of(ours.cohesion), name_of(theirs.cohesion));
    if (differs(ours.cohesion.value, theirs.cohesion.value))
        return unlike(name_of(ours.cohesion), ours.cohesion.value, theirs.cohesion.value);
    return "";
}

}  // namespace LAMMPS_NS
