// Contacts of the exact law as LAMMPS keeps them.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "kinds.h"

#include <algorithm>

namespace LAMMPS_NS {
namespace {

template <class Kind> Kind &seen(double *memory) { return *reinterpret_cast<Kind *>(memory); }

template <int N, class Real, unsigned P> CaromKind kind_of() {
    using Kind = carom::ContactInSpace<N, Real, P>;
    static_assert(alignof(Kind) <= alignof(double), "it lies in doubles");
    CaromKind kind{};
    kind.doubles = (sizeof(Kind) + sizeof(double) - 1) / sizeof(double);
    kind.number = 100.0 * N + 10.0 * sizeof(Real) + P;
    kind.touches = [](const double *memory) {
        return reinterpret_cast<const Kind *>(memory)->spacing > 0;
    };
    kind.stored = [](const double *memory) -> double {
        if constexpr ((P & carom::ledger) != 0)
            return reinterpret_cast<const Kind *>(memory)->stored;
        return static_cast<void>(memory), 0.0;
    };
    kind.advance = [](CaromBatch &batch) {
        Kind *contacts[CaromBatch::most];
        for (int k = 0; k < batch.count; ++k) contacts[k] = &seen<Kind>(batch.memories[k] + SPRINGS);
        carom::advance(contacts, batch.pairs, batch.meetings, batch.actions, batch.statuses,
                       batch.count);
    };
    kind.mirror = [](double *memory) { carom::mirror(seen<Kind>(memory)); };
    return kind;
}

template <int N, class Real> CaromKind of_parts(const CaromOptions &options) {
    using namespace carom;
    if (options.viscous)
        return options.ledger ? kind_of<N, Real, viscous | ledger>() : kind_of<N, Real, viscous>();
    return options.ledger ? kind_of<N, Real, ledger>() : kind_of<N, Real, elastic>();
}

template <int N> CaromKind of_precision(const CaromOptions &options) {
    return options.single ? of_parts<N, float>(options) : of_parts<N, double>(options);
}

/// Whether a contact is as it was in the last step, and not moved since.
bool lasts(const CaromKind &kind, const double *memory, const carom::Encounter &now) {
    const double depth = memory[DEPTH];
    return kind.touches(memory + SPRINGS) && std::fabs(now.penetration - depth) <= 1e-6 * depth;
}

/// Give contacts that last the force that they had; of the others hardly any time passes.
void stand(const CaromKind &kind, CaromBatch &batch) {
    CaromBatch met;
    int places[CaromBatch::most];
    for (int k = 0; k < batch.count; ++k) {
        carom::Encounter now = carom::one_of(batch.meetings, k);
        now.step *= 1e-3;
        batch.statuses[k] = carom::Status::ok;
        if (lasts(kind, batch.memories[k], now)) {
            carom::Action action{};
            action.force = carom_vector(batch.memories[k] + FORCE);
            carom::turn(action, now);
            carom::set_one(batch.actions, k, action);
        } else {
            places[met.count] = k;
            met.memories[met.count] = batch.memories[k];
            met.pairs[met.count] = batch.pairs[k];
            for (int lane = met.count++; lane < CaromBatch::most; ++lane)
                carom::set_one(met.meetings, lane, now);
        }
    }
    kind.advance(met);
    for (int k = 0; k < met.count; ++k) {
        carom::set_one(batch.actions, places[k], carom::one_of(met.actions, k));
        batch.statuses[places[k]] = met.statuses[k];
    }
}

}  // namespace

CaromKind carom_kind(const CaromOptions &options) {
    if (options.springs == 16) return of_precision<16>(options);
    if (options.springs == 32) return of_precision<32>(options);
    if (options.springs == 64) return of_precision<64>(options);
    return CaromKind{};
}

void carom_step(const CaromKind &kind, CaromBatch &batch, bool setup) {
    if (setup)
        stand(kind, batch);
    else
        kind.advance(batch);
}

}  // namespace LAMMPS_NS
