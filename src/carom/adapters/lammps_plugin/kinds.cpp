// Contacts of the exact law as LAMMPS keeps them.
//
// SPDX-License-Identifier: GPL-2.0-only
#include "kinds.h"

#include <algorithm>
#include <vector>

namespace LAMMPS_NS {
namespace {

template <class Kind> Kind &seen(double *memory) { return *reinterpret_cast<Kind *>(memory); }

/// What the ledger of a viscous contact has entered for compression.
template <class Kind> struct Compression {
    double normal, power, stored = 0.0;

    /// Of a contact as it is before a step: one that begins pressed has the energy of Hertz.
    Compression(const Kind &contact, const carom::Pair &pair, double from)
        : normal(contact.normal), power(contact.power) {
        if (!(contact.spacing > 0))
            stored = carom_pressed(pair, std::min(std::max(from, 0.0), pair.radius));
    }

    /// Take what a step has entered out of the ledger: the normal force is another style's.
    void leave(Kind &contact, double approach, double step, carom::Action &action) const {
        const bool parted = !(contact.spacing > 0);
        const double lost = parted ? 0.0 : 0.5 * step * (contact.power + power);
        const double work = 0.5 * step * (contact.normal + normal) * approach + stored;
        if (!parted) contact.stored -= work - lost;
        action.viscosity -= parted ? work : lost;
    }
};

/// Step contacts whose ledger is that of the tangential part alone.
template <class Kind> void advance_aside(CaromBatch &batch, void (*advance)(CaromBatch &)) {
    std::vector<Compression<Kind>> before;
    const auto approach_of = [](const carom::Encounter &now) {
        return -carom::dot(now.velocity, now.normal);
    };
    for (int k = 0; k < batch.count; ++k) {
        const carom::Encounter now = carom::one_of(batch.meetings, k);
        before.emplace_back(seen<Kind>(batch.memories[k] + SPRINGS), batch.pairs[k],
                            now.penetration - approach_of(now) * now.step);
    }
    advance(batch);
    for (int k = 0; k < batch.count; ++k) {
        if (batch.statuses[k] != carom::Status::ok) continue;
        const carom::Encounter now = carom::one_of(batch.meetings, k);
        carom::Action action = carom::one_of(batch.actions, k);
        before[k].leave(seen<Kind>(batch.memories[k] + SPRINGS), approach_of(now), now.step, action);
        carom::set_one(batch.actions, k, action);
    }
}

template <class Kind> void advance_all(CaromBatch &batch) {
    Kind *contacts[CaromBatch::most];
    for (int k = 0; k < batch.count; ++k) contacts[k] = &seen<Kind>(batch.memories[k] + SPRINGS);
    carom::advance(contacts, batch.pairs, batch.meetings, batch.actions, batch.statuses, batch.count);
}

template <int N, class Real, unsigned P> CaromKind kind_of(bool tangential) {
    using Kind = carom::ContactInSpace<N, Real, P>;
    static_assert(alignof(Kind) <= alignof(double), "it lies in doubles");
    CaromKind kind{};
    kind.doubles = (sizeof(Kind) + sizeof(double) - 1) / sizeof(double);
    constexpr double version = 30000.0;  // raised when the memory of a contact changes
    kind.number = (tangential ? 2.0 : 1.0) * version + 100.0 * N + 10.0 * sizeof(Real) + P;
    if constexpr ((P & carom::ledger) != 0) {
        kind.lost = kind.doubles;
        kind.doubles += 2;
    }
    kind.touches = [](const double *memory) {
        return reinterpret_cast<const Kind *>(memory)->spacing > 0;
    };
    kind.stored = [](const double *memory) -> double {
        if constexpr ((P & carom::ledger) != 0)
            return reinterpret_cast<const Kind *>(memory)->stored;
        return static_cast<void>(memory), 0.0;
    };
    kind.advance = advance_all<Kind>;
    if constexpr (P == (carom::viscous | carom::ledger))
        if (tangential)
            kind.advance = [](CaromBatch &batch) { advance_aside<Kind>(batch, advance_all<Kind>); };
    kind.mirror = [](double *memory) { carom::mirror(seen<Kind>(memory)); };
    return kind;
}

template <int N, class Real> CaromKind of_parts(const CaromOptions &options) {
    using namespace carom;
    const bool part = options.tangential;
    if (options.viscous)
        return options.ledger ? kind_of<N, Real, viscous | ledger>(part)
                              : kind_of<N, Real, viscous>(part);
    return options.ledger ? kind_of<N, Real, ledger>(part) : kind_of<N, Real, elastic>(part);
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

void carom_press(CaromBatch &batch) {
    for (int k = 0; k < batch.count; ++k) {
        const carom::Encounter now = carom::one_of(batch.meetings, k);
        const double depth = std::max(now.penetration, 0.0);
        const double stiffness = 4.0 / 3.0 * batch.pairs[k].modulus * std::sqrt(batch.pairs[k].radius);
        carom::Action action{};
        action.force = carom::times(stiffness * depth * std::sqrt(depth), now.normal);
        carom::set_one(batch.actions, k, action);
        batch.statuses[k] = carom::Status::ok;
    }
}

}  // namespace LAMMPS_NS
